// inner.rs

const HERE: ElementId = ElementId(0);
const SEEK: ElementId = ElementId(1);

/// The active element.
#[derive(Clone, Default)]
enum Active {
    #[default]
    None,
    // actor seek: Seek
    Seek(crate::kit::Seek),
}

/// Outputs of `here`.
fn here_outputs(staged: &mut Staged, outcome: kit::here::State) -> Result<(), BadValue> {
    let kit::here::State::Done { place: value_0 } = outcome;
    staged.to = Some(Object::new(value_0));
    Ok(())
}

/// Inputs of `seek`.
fn seek_inputs<'a>(config: &'a Config) -> Result<kit::seek::Inputs<'a>, BadValue> {
    Ok(kit::seek::Inputs {
        name: "",
        side: crate::kit::templates::Side::Left,
        r#where: input(2, || Ok(config.from()?))?,
        tries: 3,
    })
}

/// Live inputs of `seek`.
fn seek_live() -> Result<kit::seek::Live, BadValue> {
    Ok(kit::seek::Live {
        speed: Speed::from_si(0.1),
        r#loop: true,
    })
}

// p.rs

const HERE: ElementId = ElementId(0);
const INNER: ElementId = ElementId(1);

/// The active element.
#[derive(Clone, Default)]
enum Active {
    #[default]
    None,
    // subplan inner: Inner
    Inner(Machine<super::inner::Inner>),
}

/// Outputs of `here`.
fn here_outputs(staged: &mut Staged, outcome: kit::here::State) -> Result<(), BadValue> {
    let kit::here::State::Done { place: value_0 } = outcome;
    staged.place = Some(Object::new(value_0));
    Ok(())
}

/// The first ids of `inner` begin.
const INNER_PLACE: Child = Child { components: 2, entries: 1 };

/// Inputs of `inner`.
fn inner_inputs(config: &Config, to: &mut super::inner::Config) -> Result<(), BadValue> {
    to.from.set(config.place.get().clone());
    Ok(())
}

/// Results of `inner`.
fn inner_outputs(
    staged: &mut Staged,
    from: &super::inner::Config,
) -> Result<(), BadValue> {
    if let Some(value) = from.to.value() {
        staged.place = Some(value.clone());
    }
    Ok(())
}
