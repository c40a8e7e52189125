//! The files of a change, each with a buffer.

use std::rc::Rc;

use super::buffer::TextBuffer;
use super::project::{Project, paths_of_uses};
use super::{Item, Refused, refer};
use afp_dsl::Toolboxes;
use afp_dsl::files::{joined, normalised};
use afp_syntax::Token;
use afp_syntax::source::Source;

/// The files that a change may edit.
pub(super) struct Workspace {
    pub paths: Vec<String>,
    pub buffers: Vec<TextBuffer>,
    /// The file of the change's items.
    pub home: usize,
}

impl Workspace {
    pub fn new(files: &[Source], toolboxes: &Rc<Toolboxes>, home: usize) -> Workspace {
        let paths = files.iter().map(|file| normalised(&file.name)).collect();
        let buffers =
            files.iter().map(|file| TextBuffer::new(&file.text, toolboxes.clone())).collect();
        Workspace { paths, buffers, home }
    }

    pub fn buffer(&mut self) -> &mut TextBuffer {
        &mut self.buffers[self.home]
    }

    pub fn syntax_errors(&self) -> usize {
        self.buffers.iter().map(TextBuffer::syntax_errors).sum()
    }

    /// The meaning of the current texts.
    pub fn project(&self) -> Project {
        let roots: Vec<_> = self.buffers.iter().map(TextBuffer::root).collect();
        let sees = roots.iter().enumerate().map(|(index, root)| {
            let used = paths_of_uses(root).filter_map(|written| {
                let path = joined(&self.paths[index], &written);
                self.paths.iter().position(|known| *known == path)
            });
            std::iter::once(index).chain(used.filter(|used| *used != index)).collect()
        });
        let sources = self.paths.iter().zip(&self.buffers);
        let sources = sources.map(|(path, buffer)| Source::new(path, buffer.text())).collect();
        let toolboxes = self.buffers[self.home].toolboxes.clone();
        Project::new(sees.collect(), roots, sources, toolboxes)
    }

    /// Checks that no other file names an item.
    pub fn check_inside(&self, item: &Item) -> Result<(), Refused> {
        self.check_unnamed(item, |_| true)
    }

    /// Checks that no plan of another file names an item; a scenario may, since the check then
    /// marks it.
    pub fn check_unused(&self, item: &Item) -> Result<(), Refused> {
        self.check_unnamed(item, |name| refer::scenario(name).is_none())
    }

    fn check_unnamed(&self, item: &Item, counts: impl Fn(&Token) -> bool) -> Result<(), Refused> {
        let found = refer::to(&self.project(), self.home, item);
        let mut others = found.iter().filter(|(file, name)| *file != self.home && counts(name));
        let Some((file, _)) = others.next() else { return Ok(()) };
        let (name, path) = (item.name(), &self.paths[*file]);
        Err(Refused::new(format!("'{path}' uses '{name}': remove that use first")))
    }
}
