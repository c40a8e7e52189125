//! The configuration of a loaded plan: committed and staged values.

use std::any::Any;

use afp_core::rt::Committer;
use afp_core::trace::Sink;
use afp_core::{Fault, Value, ValueRef};
use afp_dsl::graph::Entry;
use afp_dsl::types::Type;

use super::numbered;

/// An object whose Rust type only its templates know.
pub trait ObjectCell: Send {
    /// The object, if set.
    fn get(&self) -> Option<&dyn Any>;
    /// Takes the object out of an `Option` of the same Rust type.
    fn take(&mut self, from: &mut dyn Any);
    /// Exchanges the objects of two cells of the same type.
    fn swap(&mut self, other: &mut dyn ObjectCell);
    /// Copies the object of a cell of the same type.
    fn copy(&mut self, from: &dyn ObjectCell);
    /// Becomes empty.
    fn clear(&mut self);
    /// The cell's `Option`, for the methods above.
    fn inner(&mut self) -> &mut dyn Any;
    /// A new cell with a copy of the object.
    fn copied(&self) -> Box<dyn ObjectCell>;
}

impl Clone for Box<dyn ObjectCell> {
    fn clone(&self) -> Self {
        (**self).copied()
    }
}

impl<T: Clone + Send + 'static> ObjectCell for Option<T> {
    fn get(&self) -> Option<&dyn Any> {
        self.as_ref().map(|object| object as &dyn Any)
    }

    fn take(&mut self, from: &mut dyn Any) {
        *self = from.downcast_mut::<Option<T>>().and_then(Option::take);
    }

    fn swap(&mut self, other: &mut dyn ObjectCell) {
        if let Some(other) = other.inner().downcast_mut::<Option<T>>() {
            std::mem::swap(self, other);
        }
    }

    fn copy(&mut self, from: &dyn ObjectCell) {
        *self = from.get().and_then(|object| object.downcast_ref::<T>()).cloned();
    }

    fn clear(&mut self) {
        *self = None;
    }

    fn inner(&mut self) -> &mut dyn Any {
        self
    }

    fn copied(&self) -> Box<dyn ObjectCell> {
        Box::new(self.clone())
    }
}

/// Makes the cell of an object type.
pub type NewCell = fn() -> Box<dyn ObjectCell>;

/// All entries of one plan. The two parts are separate, so that a component can read one while its
/// outputs go to the other.
#[derive(Clone)]
pub struct Config {
    /// The committed values.
    pub values: Values,
    /// The values of the next commit.
    pub staged: Staged,
}

#[derive(Clone)]
pub struct Values(Vec<Slot>);

/// Values to be committed.
#[derive(Clone)]
pub struct Staged {
    values: Vec<Option<Value>>,
    objects: Vec<Option<Box<dyn ObjectCell>>>,
    dirty: bool,
}

#[derive(Clone)]
struct Slot {
    ty: Type,
    /// The type's zero while unset.
    value: Value,
    is_set: bool,
    object: Option<Box<dyn ObjectCell>>,
    /// The commit that identified an object before it was committed here.
    source: u32,
}

impl Config {
    /// Unset entries; `cell` makes the cells of object types.
    pub fn new(entries: &[Entry], cell: impl Fn(&Type) -> Option<NewCell>) -> Self {
        let object = |entry: &Entry| cell(&entry.ty).map(|new| new());
        let slots = entries.iter().map(|entry| Slot {
            ty: entry.ty.clone(),
            value: zero(&entry.ty),
            is_set: false,
            object: object(entry),
            source: 0,
        });
        Config {
            values: Values(slots.collect()),
            staged: Staged {
                values: entries.iter().map(|_| None).collect(),
                objects: entries.iter().map(object).collect(),
                dirty: false,
            },
        }
    }

    #[inline]
    pub fn commit<S: Sink>(&mut self, to: &mut Committer<'_, S>) {
        if self.staged.dirty {
            self.commit_staged(to);
        }
    }

    fn commit_staged<S: Sink>(&mut self, to: &mut Committer<'_, S>) {
        self.staged.dirty = false;
        let staged = self.staged.values.iter_mut().zip(&mut self.staged.objects);
        for (entry, (slot, (value, object))) in numbered(self.values.0.iter_mut().zip(staged)) {
            let Some(mut value) = value.take() else { continue };
            if let (Value::Object(number), Some(to_cell), Some(from)) =
                (&mut value, &mut slot.object, object)
            {
                slot.source = *number;
                *number = to.number();
                to_cell.swap(&mut **from);
                from.clear();
            }
            let old = if slot.is_set { slot.value.as_deref() } else { ValueRef::Unset };
            to.wrote(entry, old, value.as_deref());
            slot.value = value;
            slot.is_set = true;
        }
    }
}

impl Values {
    /// The value; the type's zero while unset.
    #[inline]
    pub fn get(&self, entry: u16) -> &Value {
        self.0.get(usize::from(entry)).map_or(&Value::Unset, |slot| &slot.value)
    }

    pub fn ty(&self, entry: u16) -> Option<&Type> {
        self.0.get(usize::from(entry)).map(|slot| &slot.ty)
    }

    /// The object of an entry.
    ///
    /// # Errors
    /// [`Fault::UNSET`] if there is none.
    pub fn object(&self, entry: u16) -> Result<&dyn Any, Fault> {
        self.cell(entry).and_then(ObjectCell::get).ok_or(Fault::UNSET)
    }

    pub fn cell(&self, entry: u16) -> Option<&dyn ObjectCell> {
        self.0.get(usize::from(entry))?.object.as_deref()
    }

    pub fn is_set(&self, entry: u16) -> bool {
        self.0.get(usize::from(entry)).is_some_and(|slot| slot.is_set)
    }

    /// The value as traced.
    pub fn show(&self, entry: u16) -> ValueRef<'_> {
        match self.0.get(usize::from(entry)) {
            Some(slot) if slot.is_set => slot.value.as_deref(),
            _ => ValueRef::Unset,
        }
    }

    /// Sets an entry without a commit: an input before the start, or an initial value. An object
    /// entry gets a copy of `object`.
    pub fn set(&mut self, entry: u16, value: Value, object: Option<&dyn ObjectCell>) {
        let Some(slot) = self.0.get_mut(usize::from(entry)) else { return };
        slot.value = value;
        slot.is_set = true;
        if let (Some(cell), Some(from)) = (&mut slot.object, object) {
            cell.copy(from);
        }
    }

    /// Copies an object to another entry without a commit.
    pub fn copy(&mut self, from: u16, to: u16) {
        let places = [usize::from(from), usize::from(to)];
        let Ok([from, to]) = self.0.get_disjoint_mut(places) else { return };
        to.value = from.value.clone();
        to.is_set = true;
        if let (Some(cell), Some(from)) = (&mut to.object, &from.object) {
            cell.copy(&**from);
        }
    }

    /// Whether a live value is unchanged since it was last passed.
    pub fn is_still(&self, entry: u16, passed: &Value) -> bool {
        let Some(slot) = self.0.get(usize::from(entry)) else { return true };
        let source = slot.object.as_ref().map(|_| Value::Object(slot.source));
        slot.value.as_deref().is_same(passed.as_deref()) || source.as_ref() == Some(passed)
    }

    pub fn clear(&mut self, entry: u16) {
        let Some(slot) = self.0.get_mut(usize::from(entry)) else { return };
        slot.value = zero(&slot.ty);
        slot.is_set = false;
        if let Some(cell) = &mut slot.object {
            cell.clear();
        }
    }
}

impl Staged {
    /// Stages a value of the entry's own type.
    pub fn put(&mut self, entry: u16, value: Value) {
        if let Some(slot) = self.values.get_mut(usize::from(entry)) {
            *slot = Some(value);
            self.dirty = true;
        }
    }

    /// Stages an object: `fill` puts it into the shadow cell.
    pub fn put_object(&mut self, entry: u16, fill: impl FnOnce(&mut dyn ObjectCell)) {
        self.put_known(entry, 0, fill);
    }

    /// Stages an object identified by the number of a commit.
    pub fn put_known(&mut self, entry: u16, commit: u32, fill: impl FnOnce(&mut dyn ObjectCell)) {
        if let Some(Some(cell)) = self.objects.get_mut(usize::from(entry)) {
            fill(&mut **cell);
            self.put(entry, Value::Object(commit));
        }
    }

    #[inline]
    pub fn discard(&mut self) {
        if self.dirty {
            self.dirty = false;
            self.values.fill(None);
            self.objects.iter_mut().flatten().for_each(|cell| cell.clear());
        }
    }
}

/// The value of unset storage.
fn zero(ty: &Type) -> Value {
    match ty {
        Type::Bool => Value::Bool(false),
        Type::Int => Value::Int(0),
        Type::Quantity(_) => Value::Float(0.0),
        Type::Text => Value::Text(afp_core::Text::new()),
        Type::Enum(_) => Value::Choice(0),
        Type::Object(_) => Value::Object(0),
        Type::Any | Type::Number | Type::Discrete => Value::Unset,
    }
}
