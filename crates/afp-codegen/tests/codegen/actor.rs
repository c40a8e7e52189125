// p.rs

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
    staged.place = Some(Object::new(value_0));
    Ok(())
}

/// Inputs of `seek`.
fn seek_inputs<'a>(config: &'a Config) -> Result<kit::seek::Inputs<'a>, BadValue> {
    Ok(kit::seek::Inputs {
        name: config.text(),
        side: crate::kit::templates::Side::Right,
        r#where: input(2, || Ok(config.place()?))?,
        tries: 5,
    })
}

/// Live inputs of `seek`.
fn seek_live(config: &Config) -> Result<kit::seek::Live, BadValue> {
    Ok(kit::seek::Live {
        speed: config.pace(),
        r#loop: true,
    })
}

/// Outputs of `seek`.
fn seek_outputs(staged: &mut Staged, outcome: kit::seek::State) -> Result<(), BadValue> {
    match outcome {
        kit::seek::State::Found { place: value_0, said: value_1 } => {
            staged.found = Some(Object::new(value_0));
            staged.text = Some(value_1);
        }
        kit::seek::State::Lost { said: value_1, turn: value_2 } => {
            staged.text = Some(value_1);
            staged.turn = Some(output(2, || finite(value_2))?);
        }
        _ => {}
    }
    Ok(())
}
