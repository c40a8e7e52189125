//! Templates of other robots, and templates for missing parts of this robot.
//!
//! A robot has the devices of its toolbox. These may include devices of another robot's toolbox, by
//! name; the robot then supports that toolbox's templates for them.

use crate::check::signature::Signature;
use crate::gather::Toolboxes;
use crate::toolbox::{Device, DeviceKind, Template, TemplateKind, Toolbox};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;
use afp_syntax::source::Span;

/// Reports a template of another robot's toolbox that needs a missing device: a commanded one or,
/// for a supervisor, any sensor of that toolbox.
pub(crate) fn check(
    toolboxes: &Toolboxes,
    signature: &Signature,
    used: Span,
    diags: &mut Diagnostics,
) {
    let (Some(template), Some((_, toolbox))) = (signature.template(), &signature.template) else {
        return;
    };
    let Some(robot) = toolboxes.said_robot().filter(|_| toolboxes.is_of_another_robot(toolbox))
    else {
        return missing_part(toolboxes, (template, toolbox), used, diags);
    };
    let lacks = |device: &&Device| robot.devices.iter().all(|own| own.name != device.name);
    let commanded = |device: &&Device| template.uses.contains(&device.name);
    let (name, other, own) = (&template.name, &toolbox.name, &robot.name);
    let looks = template.kind == TemplateKind::Supervisor;
    let missing = toolbox.devices.iter().filter(commanded).find(lacks);
    let (message, help) = match missing {
        Some(device) => (
            message!(
                "'{}' of '{}' commands '{}', which the robot '{}' does not have",
                name,
                other,
                device.name,
                own
            ),
            message!(
                "use a template of '{}'; or, if the robot does what '{}' asks for, declare '{} {} {{}}' in its toolbox",
                own,
                name,
                if device.kind == DeviceKind::Sensor { "sensor" } else { "device" },
                device.name
            ),
        ),
        None if looks && sensors(toolbox).all(|sensor| lacks(&sensor)) => (
            message!(
                "'{}' reads sensors of '{}', which the robot '{}' does not have",
                name,
                other,
                own
            ),
            message!(
                "use a supervisor of '{}'; or, if the robot has what '{}' looks at, declare it in its toolbox under its name in '{}'",
                own,
                name,
                other
            ),
        ),
        None => return,
    };
    let mut diagnostic = Diagnostic::new(Code::E0518, used, message).help(help);
    if let Some(device) = missing {
        diagnostic = diagnostic.note(device.span, "declared here");
    }
    diags.push(diagnostic.note(robot.span, "the toolbox of the robot that plans run on"));
}

/// Reports a template that commands or needs a device of the robot's toolbox that this robot does
/// not have, or needs a sensor whose readings this robot estimates.
fn missing_part(
    toolboxes: &Toolboxes,
    (template, toolbox): (&Template, &Toolbox),
    used: Span,
    diags: &mut Diagnostics,
) {
    let of = |names: &[String], is: fn(&Toolboxes, &str) -> bool| {
        let mut devices = toolbox.devices.iter().filter(|device| names.contains(&device.name));
        devices.find(|device| is(toolboxes, &device.name))
    };
    let name = &template.name;
    let (code, device, message) = if let Some(device) = of(&template.uses, Toolboxes::lacks) {
        let message =
            message!("'{}' commands '{}', which the robot does not have", name, device.name);
        (Code::E0518, device, message)
    } else if let Some(device) = of(&template.needs, Toolboxes::lacks) {
        let message = message!("'{}' needs '{}', which the robot does not have", name, device.name);
        (Code::E0518, device, message)
    } else if let Some(device) = of(&template.needs, Toolboxes::estimates) {
        let message =
            message!("'{}' needs '{}', which the robot only estimates", name, device.name);
        (Code::E0520, device, message)
    } else {
        return;
    };
    let help = match code {
        Code::E0518 => "use another template, or describe the part in '[robot]' of afp.toml",
        _ => "let a sensor that the robot has end it",
    };
    let diagnostic = Diagnostic::new(code, used, message).help(help);
    diags.push(diagnostic.note(device.span, "declared here"));
}

fn sensors(toolbox: &Toolbox) -> impl Iterator<Item = &Device> {
    toolbox.devices.iter().filter(|device| device.kind == DeviceKind::Sensor)
}

#[cfg(test)]
mod tests {
    use crate::compile_plan;
    use crate::files::Texts;
    use crate::gather::Toolboxes;
    use afp_syntax::source::Source;

    const CRANE: &str = "toolbox crane version \"1\"\ndevice arm { fault stuck }\nsensor eye { signal near: bool }\n\
                         robot { truth pose: pose }\nactor Grip { uses arm state Done }\n\
                         supervisor Look { needs eye event Seen }\ncomputation Guess { state Done }\n";
    const PLAN: &str = "use crane\nplan P {\n    start guess\n    supervise look: Look { Seen -> terminate }\n    \
                        computation guess: Guess { Done -> grip }\n    actor grip: Grip { Done -> terminate }\n}\n";

    /// Columns of the names rejected for a cart with these devices.
    fn refused(devices: &str) -> Vec<String> {
        let cart = format!("toolbox cart version \"1\"\nrobot {{ truth pose: pose }}\n{devices}\n");
        let files = [("crane.afp", CRANE, "crane"), ("cart.afp", &cart, "cart")];
        let mut toolboxes: Toolboxes = files.into_iter().collect();
        toolboxes.set_robot("cart");
        let compiled =
            compile_plan(&Source::new("p.afp", PLAN), &toolboxes, &Texts::default(), None);
        let told = compiled.diags.iter().map(|it| {
            assert_eq!(it.code.as_str(), "E0518");
            compiled.sources.text(it.span).to_owned()
        });
        told.collect()
    }

    #[test]
    fn a_missing_part_of_the_robot_is_reported_at_its_templates() {
        let mut toolboxes: Toolboxes = [("crane.afp", CRANE, "crane")].into_iter().collect();
        for (lacks, expected) in [("arm", vec!["Grip"]), ("eye", vec!["Look"])] {
            toolboxes.set_lacks([lacks.to_owned()]);
            let plan = Source::new("p.afp", PLAN);
            let compiled = compile_plan(&plan, &toolboxes, &Texts::default(), None);
            let told = compiled.diags.iter().map(|it| compiled.sources.text(it.span).to_owned());
            assert_eq!(told.collect::<Vec<_>>(), expected, "{lacks}");
        }
    }

    #[test]
    fn an_estimated_sensor_is_a_note_and_not_an_error() {
        let mut toolboxes: Toolboxes = [("crane.afp", CRANE, "crane")].into_iter().collect();
        toolboxes.set_estimates(["eye".to_owned()]);
        let plan = Source::new("p.afp", PLAN);
        let compiled = compile_plan(&plan, &toolboxes, &Texts::default(), None);
        let told: Vec<_> = compiled.diags.iter().map(|it| it.code.as_str()).collect();
        assert_eq!(told, ["E0520"]);
        assert!(compiled.graph.is_some());
    }

    #[test]
    fn a_robot_runs_templates_that_need_only_its_devices() {
        assert_eq!(refused(""), ["Look", "Grip"]);
        assert_eq!(refused("device arm { fault torn }"), ["Look"]);
        assert_eq!(refused("sensor eye { signal far: bool }"), ["Grip"]);
        assert_eq!(
            refused("device arm {}\nsensor eye { signal near: bool }"),
            Vec::<String>::new()
        );
    }
}
