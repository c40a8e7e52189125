//! Unique names of plans.

use std::collections::HashSet;

/// The names, made unique: a duplicate name gets a number that makes a new name: `P`, `P_3` for
/// `P`, `P_2`, `P`.
pub fn free_names<'a>(names: impl Iterator<Item = &'a str> + Clone) -> Vec<String> {
    let all: HashSet<&str> = names.clone().collect();
    let mut given = HashSet::new();
    let free = |name: &str| {
        if given.insert(name.to_owned()) {
            return name.to_owned();
        }
        let numbered = (2..).map(|number: u64| format!("{name}_{number}"));
        let mut free = numbered.filter(|name| !all.contains(&**name));
        free.find(|name| given.insert(name.clone())).unwrap_or_default()
    };
    names.map(free).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_does_not_make_an_existing_name() {
        let names = ["P", "P", "P_2", "P", "Q"];
        assert_eq!(free_names(names.into_iter()), ["P", "P_3", "P_2", "P_4", "Q"]);
    }
}
