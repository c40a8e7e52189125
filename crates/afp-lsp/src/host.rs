//! Where texts come from that no client has open.

/// The surroundings of a server.
pub trait Host: Send {
    /// The text of a file. Paths are absolute, their parts separated by `/`.
    ///
    /// # Errors
    /// Why there is no text: lower case, no final period.
    fn read(&self, path: &str) -> Result<String, String>;

    /// The `.afp` files below a folder, as paths.
    fn plan_files(&self, folder: &str) -> Vec<String>;

    /// A path under which an editor finds a built-in toolbox, given by its file name and text; without
    /// one it gets the address `afp:/NAME` and asks the server for the text.
    fn built_in(&self, name: &str, text: &str) -> Option<String>;

    /// A picture as the bytes of a PNG file.
    ///
    /// # Errors
    /// Why there are none, and what to do.
    fn png(&self, svg: &str) -> Result<Vec<u8>, String> {
        let _ = svg;
        Err("this server makes no pixels: take 'svg'".to_owned())
    }
}

/// Surroundings without any file: all that there is, clients have open.
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
