//! Selects the units that an error lists.

/// Common units, the most common first.
const USUAL: [&str; 20] = [
    "m", "cm", "mm", "km", "deg", "rad", "s", "ms", "min", "h", "m/s", "cm/s", "mm/s", "km/h",
    "deg/s", "rad/s", "kg", "g", "degC", "K",
];

/// The number of units that are listed.
const NAMED: usize = 8;

/// Lists some of the units, common ones first: `m/s, cm/s, mm/s, km/h, ...`.
pub fn some_units<'a>(units: impl IntoIterator<Item = &'a str>) -> String {
    let mut units: Vec<&str> = units.into_iter().collect();
    units.sort_by_key(|unit| USUAL.iter().position(|usual| usual == unit).unwrap_or(USUAL.len()));
    units.truncate(NAMED);
    units.join(", ")
}

#[cfg(test)]
mod tests {
    #[test]
    fn usual_units_have_names() {
        let units = ["um/s", "m/ns", "km/h", "m/h", "cm/s", "m/s", "mm/s", "m/us", "m/min", "um/h"];
        assert_eq!(super::some_units(units), "m/s, cm/s, mm/s, km/h, um/s, m/ns, m/h, m/us");
        assert_eq!(super::some_units(["V", "mV"]), "V, mV");
    }
}
