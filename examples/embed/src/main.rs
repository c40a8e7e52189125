//! Follows a wall, then runs some errands, and prints the results.

use afp::quantity::Length;
use embed::{Error, errand, fetch, follow, open};

fn main() -> Result<(), Error> {
    let mut shop = open(include_str!("../../../worlds/wall_following.toml"), 1)?;
    let followed = follow(&mut shop, Length::from_si(0.25), Length::from_si(0.35), 20)?;
    for activation in &followed.activations {
        println!("{activation}");
    }
    if let Some(angle) = followed.wall_angle {
        println!("the last wall was at {:.1} deg", angle.si().to_degrees());
    }
    let mut shop = open(include_str!("../room.toml"), 1)?;
    println!("errands: {:?}, announced {:?}", fetch(&mut shop, 2)?, shop.announced);
    println!("one errand: {:?}", errand(&mut shop, Length::from_si(0.3))?);
    Ok(())
}
