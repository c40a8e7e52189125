//! Texts that no client has open.

/// The environment of a server.
pub trait Host: Send {
    /// Returns the text of a file. Paths are absolute with `/` separators.
    ///
    /// # Errors
    /// The reason: lower case, no final period.
    fn read(&self, path: &str) -> Result<String, String>;

    /// Returns the paths of the `.afp` files below a folder.
    fn plan_files(&self, folder: &str) -> Vec<String>;

    /// Returns a path at which an editor finds a built-in toolbox, given its file name and text.
    /// The default is the address `afp:/NAME`, whose text editors request from the server.
    fn built_in(&self, name: &str, text: &str) -> Option<String>;

    /// Converts a picture to the bytes of a PNG file.
    ///
    /// # Errors
    /// The reason and an action.
    fn png(&self, svg: &str) -> Result<Vec<u8>, String> {
        let _ = svg;
        Err("this server cannot draw pixels: use 'svg'".to_owned())
    }
}

/// An environment without files: all texts come from clients.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoFiles;

impl Host for NoFiles {
    fn read(&self, _: &str) -> Result<String, String> {
        Err("there is no such file".to_owned())
    }

    fn plan_files(&self, _: &str) -> Vec<String> {
        Vec::new()
    }

    fn built_in(&self, _: &str, _: &str) -> Option<String> {
        None
    }
}
