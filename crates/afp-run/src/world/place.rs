//! Paths in a world's file: elements of tables and lists, by name or by number.

use toml_edit::{Item, Table};

pub struct Place<'a> {
    /// The value; empty if a table is about to get it.
    pub item: &'a mut Item,
    /// Whether it is an element of a list.
    pub listed: bool,
}

impl<'a> Place<'a> {
    /// Finds the value of a path: a key in a table, a name or a number from 0 in a list. Missing
    /// tables are created.
    ///
    /// # Errors
    /// The value does not exist, or is more than one value.
    pub fn find(root: &'a mut Item, way: &[&str]) -> Result<Self, String> {
        let mut place = Place { item: root, listed: false };
        let mut holder = "";
        for (number, part) in way.iter().enumerate() {
            place = match (place.item.is_table_like(), way.get(number + 1)) {
                (true, next) => place.key(part, next.copied())?,
                (false, _) => place.one_of(holder, part)?,
            };
            holder = part;
        }
        match place.item {
            item if item.is_table_like() => {
                Err(format!("'{holder}' is a table; also name its key"))
            }
            item if item.is_array() || item.is_array_of_tables() => {
                Err(format!("'{holder}' is a list; also name its item"))
            }
            item => Ok(Place { item, ..place }),
        }
    }

    /// The value of a key; a new table if it is missing and `next` is not a number.
    fn key(self, name: &str, next: Option<&str>) -> Result<Self, String> {
        let table = self.item.as_table_like_mut().ok_or_else(|| absent(name))?;
        if let Some(next) = next.filter(|_| !table.contains_key(name)) {
            if next.parse::<usize>().is_ok() {
                let known: Vec<_> = table.iter().map(|(name, _)| format!("'{name}'")).collect();
                return Err(format!("there is no '{name}' among {}", known.join(", ")));
            }
            table.insert(name, Item::Table(Table::new()));
        }
        let item = self.item.get_mut(name).ok_or_else(|| absent(name))?;
        Ok(Place { item, listed: false })
    }

    /// The element of that name or number in the list `holder`.
    fn one_of(self, holder: &str, part: &str) -> Result<Self, String> {
        let number = part.parse::<usize>().ok();
        let shown = number.map_or_else(|| format!("'{part}'"), |number| format!("number {number}"));
        let Some(names) = names(self.item) else {
            return Err(format!("'{holder}' is not a list, so it has no {shown}"));
        };
        let by_number = number.filter(|number| *number < names.len());
        let by_name = names.iter().position(|name| name.as_deref() == Some(part));
        let Some(index) = by_name.or(by_number) else {
            return Err(match names.iter().any(Option::is_some) {
                true => format!("there is no '{part}' among {}", listed(&names)),
                false => {
                    format!("'{holder}' has {}, from 0 on, and no {shown}", values(names.len()))
                }
            });
        };
        let item = self.item.get_mut(index).ok_or_else(|| absent(part))?;
        Ok(Place { item, listed: true })
    }
}

/// The names of the elements of a list; `None` for other items.
fn names(item: &Item) -> Option<Vec<Option<String>>> {
    let tables = item.as_array_of_tables();
    let named = |table: &Table| Some(table.get("name")?.as_str()?.to_owned());
    if let Some(tables) = tables {
        return Some(tables.iter().map(named).collect());
    }
    let named =
        |value: &toml_edit::Value| Some(value.as_inline_table()?.get("name")?.as_str()?.to_owned());
    Some(item.as_array()?.iter().map(named).collect())
}

/// The names, and numbers for elements without one.
fn listed(names: &[Option<String>]) -> String {
    let one = |(number, name): (usize, &Option<String>)| match name {
        Some(name) => format!("'{name}'"),
        None => number.to_string(),
    };
    names.iter().enumerate().map(one).collect::<Vec<_>>().join(", ")
}

fn values(count: usize) -> String {
    format!("{count} value{}", if count == 1 { "" } else { "s" })
}

fn absent(part: &str) -> String {
    format!("there is no '{part}'")
}
