use super::{
    Formula, Name, Type, child, children, doc, keyword_token, named, range, range_ends, token,
    views,
};
use crate::kind::Kind;
use crate::source::Span;

views! {
    /// `device`, `sensor` or `robot` with its parts.
    Device
    /// `press left right` or `stop escape`
    Press
    Control
    Fault
    Amount
    Signal
}

named! { Device Control Fault Signal }

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DeviceKind {
    Device,
    /// A sensor, which also has the faults of all sensors.
    Sensor,
    Robot,
}

#[derive(Clone, Debug)]
pub enum DevicePart {
    Press(Press),
    Fault(Fault),
    Signal(Signal),
}

impl Device {
    pub fn kind(&self) -> DeviceKind {
        match self.keyword().map(|word| word.text).as_deref() {
            Some("sensor") => DeviceKind::Sensor,
            Some("robot") => DeviceKind::Robot,
            _ => DeviceKind::Device,
        }
    }

    /// `device`, `sensor` or `robot`, with its place.
    pub fn keyword(&self) -> Option<Name> {
        keyword_token(&self.node, self.file)
    }

    pub fn parts(&self) -> Vec<DevicePart> {
        let file = self.file;
        let part = |node: crate::Node| {
            Some(match node.kind() {
                Kind::Press => DevicePart::Press(Press::new(node, file)),
                Kind::Fault => DevicePart::Fault(Fault::new(node, file)),
                Kind::Signal => DevicePart::Signal(Signal::new(node, file)),
                _ => return None,
            })
        };
        self.node.children().filter_map(part).collect()
    }
}

impl Press {
    /// `press` or `stop`, with its place.
    pub fn keyword(&self) -> Option<Name> {
        keyword_token(&self.node, self.file)
    }

    /// Its `///` lines, which describe all of its controls.
    pub fn doc(&self) -> String {
        doc(&self.node)
    }

    pub fn controls(&self) -> Vec<Control> {
        let controls = children(&self.node, Kind::Control);
        controls.map(|node| Control::new(node, self.file)).collect()
    }
}

impl Fault {
    pub fn amount(&self) -> Option<Amount> {
        child(&self.node, Kind::Amount).map(|node| Amount::new(node, self.file))
    }
}

impl Amount {
    pub fn name(&self) -> Option<Name> {
        token(&self.node, Kind::Name, self.file)
    }

    pub fn ty(&self) -> Option<Type> {
        child(&self.node, Kind::Type).map(|node| Type::new(node, self.file))
    }

    /// The amount if a request gives none.
    pub fn default(&self) -> Option<Formula> {
        Formula::child_of(&self.node, self.file)
    }

    /// The bounds, and the place of both.
    pub fn range(&self) -> Option<(Formula, Formula, Span)> {
        range(&self.node, self.file)
    }

    /// The bounds, as far as written.
    pub fn ends(&self) -> Vec<Formula> {
        range_ends(&self.node, self.file)
    }
}

impl Signal {
    /// `signal` or `truth`, with its place.
    pub fn keyword(&self) -> Option<Name> {
        keyword_token(&self.node, self.file)
    }

    pub fn ty(&self) -> Option<Type> {
        child(&self.node, Kind::Type).map(|node| Type::new(node, self.file))
    }
}
