use super::{Formula, Type, child, children, named, note, views};
use crate::kind::Kind;

views! {
    /// `table route(x: length, y: length) { (1 m, 2 m) }`
    Table
    /// `x: length`
    Column
    /// `(1 m, 2 m)`
    Row
}

named! { Table Column }

impl Table {
    /// The comment above it.
    pub fn note(&self) -> String {
        note(&self.node)
    }

    pub fn columns(&self) -> Vec<Column> {
        let columns = child(&self.node, Kind::Columns);
        let columns = columns.iter().flat_map(|node| children(node, Kind::Column));
        columns.map(|node| Column::new(node, self.file)).collect()
    }

    pub fn rows(&self) -> Vec<Row> {
        children(&self.node, Kind::Row).map(|node| Row::new(node, self.file)).collect()
    }
}

impl Column {
    pub fn ty(&self) -> Option<Type> {
        child(&self.node, Kind::Type).map(|node| Type::new(node, self.file))
    }
}

impl Row {
    /// Its values in order; `None` for a value that cannot be read.
    pub fn cells(&self) -> Vec<Option<Formula>> {
        children(&self.node, Kind::Cell).map(|node| Formula::child_of(&node, self.file)).collect()
    }
}
