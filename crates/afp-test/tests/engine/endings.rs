//! Expected endings, and the display of differing values.

use super::run_of;

#[test]
fn only_a_claim_that_names_error_expects_one() {
    const FAILS: &str = r#"
use carbot
use std
plan Ahead {
    start work
    actor work: Wait(duration = 1 s) { Elapsed -> fail "broken" }
}
"#;
    let help = "the plan ended in Error: broken; if it must, write 'expect end by Error'";
    for lines in [
        "never end by OK",
        "never end by work.Error",
        "never end before 500 ms",
        "never end by Error after 1.5 s",
        "expect end",
        "expect end after 500 ms",
        "expect end by work",
        "expect end by work.Elapsed once",
        "expect work -> fail",
        "never end by Interrupted\n expect work.Elapsed",
    ] {
        let broken = run_of(FAILS, lines).broken;
        let [broken] = broken.as_slice() else { panic!("{lines}: {broken:?}") };
        assert_eq!(broken.why, help, "{lines}");
        assert_eq!(broken.at.as_secs_f64(), 1.0);
    }
    for lines in ["expect end by Error", "expect end by Error once before 2 s\n never end by OK"] {
        let verdict = run_of(FAILS, lines);
        assert!(verdict.passed(), "{lines}: {}", verdict.report());
    }
    let fault = FAILS.replace(
        "duration = 1 s) { Elapsed -> fail \"broken\"",
        "duration = 1 s) { Elapsed -> terminate",
    );
    let verdict = run_of(&fault, "at 500 ms: fire work.Error\n expect end by work.Error");
    assert!(verdict.passed(), "{}", verdict.report());
}

#[test]
fn a_wrong_value_never_looks_like_the_expected_one() {
    let plan = r#"
        use carbot
        use std
        plan Ahead {
            in far: length = 2.0000001 cm
            in near: length = 2 cm
            in share: float = 3.0000001
            in count: int = 3
            start wait
            actor wait: Wait(duration = 1 s) { Elapsed -> terminate }
        }"#;
    for (claim, is) in [
        ("far == 2 cm", "0.020000001 m"),
        ("far == near", "0.020000001 m, compared with 0.02 m"),
        ("near == far", "0.02 m, compared with 0.020000001 m"),
        ("share == 3", "3.0000001"),
        ("count == share", "3, compared with 3.0000001"),
        ("far == 3 cm", "2 cm"),
    ] {
        let broken = run_of(plan, &format!("expect {claim}\n until 1 s")).broken;
        let whys: Vec<_> = broken.iter().map(|broken| broken.why.as_str()).collect();
        assert_eq!(whys, [format!("it did not hold; in the end it is {is}")], "{claim}");
    }
}
