//! Calls as in other languages, such as `robot.turn(90)`, and the plan text that does the same.

use super::sensors::words;

/// The words of calls, each with the plan text; `{here}` is an element.
const ACTIONS: &[(&[&str], &str)] = &[
    (&["timer", "interval"], "supervise tick: Every(period = 1 s) { Due -> {here} }"),
    (
        &["goal", "navigate"],
        "actor there: DriveTo(x = 1 m, y = 1 m, heading = 0 deg) { Arrived, PathLost -> {here} }",
    ),
    (
        &["subscribe", "subscription", "subscriber", "callback", "listen", "listener", "interrupt"],
        "supervise near: CheckDistance(distance = 30 cm) { Nearer -> {here}, Farther -> ignore }",
    ),
    (
        &["publish", "publisher", "emit", "send", "advertise", "broadcast"],
        "supervise changed: Changed(value = {int}) { Changed -> {here} }",
    ),
    (
        &["print", "println", "printf", "info", "warn", "debug", "logger", "say", "write", "log"],
        "computation show: Log(value = {int}) { Done -> {here} }",
    ),
    (
        &["sleep", "wait", "delay", "pause"],
        "actor wait: Wait(duration = 1 s) { Elapsed -> {here} }",
    ),
    (
        &[
            "beep", "speaker", "light", "lights", "led", "lamp", "sound", "play", "blink", "tone",
            "note", "buzzer", "horn", "music", "display", "screen",
        ],
        "actor show: Signal { Signalled -> {here} }",
    ),
    (&["stop", "brake", "halt"], "actor halt: Stop { Stopped -> {here} }"),
    (
        &[
            "turn",
            "rotate",
            "spin",
            "point",
            "direction",
            "steer",
            "pivot",
            "left",
            "right",
            "drehe",
        ],
        "actor rotate: Turn(angle = 90 deg) { TurnSuccessful -> {here} }",
    ),
];

/// The plan text for the last known word of a call.
pub(crate) fn action<'n>(names: impl DoubleEndedIterator<Item = &'n str>) -> &'static str {
    let of = |word: &String| ACTIONS.iter().find(|(known, _)| known.contains(&&**word));
    let mut found = names.rev().flat_map(words).filter_map(|word| of(&word));
    let drive = "actor drive: Forward(distance = 10 cm) { ForwardSuccessful -> {here} }";
    found.next().map_or(drive, |(_, text)| text)
}
