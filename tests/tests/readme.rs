//! The README shows what is there.

#[allow(dead_code)]
#[path = "readme/signals.rs"]
mod signals;

const README: &str = include_str!("../../README.md");

/// The fenced blocks of a language.
fn blocks(language: &str) -> impl Iterator<Item = &'static str> {
    let fence = format!("```{language}\n");
    let starts = README.match_indices(&fence).map(|(at, fence)| at + fence.len());
    let starts: Vec<_> = starts.collect();
    starts.into_iter().map(|start| {
        let rest = &README[start..];
        &rest[..rest.find("\n```").expect("the block ends") + 1]
    })
}

#[test]
fn the_plan_in_the_readme_is_the_plan_that_runs() {
    let plan = include_str!("../../plans/wall_following.afp");
    assert_eq!(blocks("afp").next(), Some(plan));
}

#[test]
fn the_template_in_the_readme_is_the_one_that_compiles() {
    assert_eq!(blocks("afp").nth(1), Some(include_str!("readme/signals.afp")));
    let code = include_str!("readme/signals.rs").replace("tests/readme/", "");
    assert_eq!(blocks("rust").next(), Some(code.as_str()));
}

/// A lamp that counts how often it goes on.
#[derive(Default)]
struct CountingLamp {
    on: bool,
    times: u32,
}

impl signals::Lamp for CountingLamp {
    fn light(&mut self, on: bool) {
        self.times += u32::from(on && !self.on);
        self.on = on;
    }
}

#[test]
fn the_template_in_the_readme_does_what_it_says() {
    use afp::{Actor, Duration, Instant, Poll, quantity::Time};
    use signals::{Blink, templates};
    let mut lamp = CountingLamp::default();
    let inputs = templates::blink::Inputs { times: 3, period: Time::from_si(0.5) };
    let mut now = Instant::ZERO;
    let mut blink: Blink = Actor::<templates::Blink, _>::start(inputs, &mut lamp, now).unwrap();
    while Actor::<templates::Blink, _>::poll(&mut blink, templates::blink::Live {}, &mut lamp, now)
        == Ok(Poll::Pending)
    {
        now += Duration::from_millis(10);
    }
    assert_eq!((lamp.on, lamp.times, now), (false, 3, Instant::from_nanos(2_500_000_000)));
}

#[test]
fn what_the_readme_points_to_exists() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let links = README.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
    for (link, _) in links.filter(|(link, _)| !link.starts_with("http")) {
        let (path, heading) = link.split_once('#').unwrap_or((link, ""));
        assert!(root.join(path).exists(), "{link}");
        if !heading.is_empty() {
            let page = std::fs::read_to_string(root.join(path)).unwrap();
            let titles = page
                .lines()
                .filter_map(|line| Some(line.strip_prefix('#')?.trim_start_matches('#')));
            let slugs = titles.map(|title| title.trim().to_lowercase().replace(' ', "-"));
            assert!(slugs.into_iter().any(|slug| slug == heading), "{link}");
        }
    }
}
