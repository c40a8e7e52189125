//! A test client that numbers its requests and records the server's messages.

use std::collections::BTreeMap;

use afp_lsp::{Host, Message, Server};
use lsp_server::{Notification, Request};
use serde_json::{Value, json};

#[derive(Clone, Debug, Default)]
pub struct Files(pub BTreeMap<String, String>);

impl Host for Files {
    fn read(&self, path: &str) -> Result<String, String> {
        self.0.get(path).cloned().ok_or_else(|| "there is no such file".to_owned())
    }

    fn plan_files(&self, folder: &str) -> Vec<String> {
        let below = |path: &&String| path.starts_with(folder) && path.ends_with(".afp");
        self.0.keys().filter(below).cloned().collect()
    }

    fn built_in(&self, _: &str, _: &str) -> Option<String> {
        None
    }
}

pub struct Client {
    pub server: Server,
    asked: i32,
}

impl Client {
    /// A client before its first message.
    pub fn new(host: impl Host + 'static) -> Client {
        Client { server: Server::new(Box::new(host)), asked: 0 }
    }

    /// An initialized client with many capabilities and the workspace `/w`.
    pub fn ready(host: impl Host + 'static) -> Client {
        let mut client = Client::new(host);
        let commands = json!({ "commands": ["afp.run", "afp.debug"] });
        let params = json!({
            "rootUri": "file:///w", "capabilities": {}, "initializationOptions": commands,
        });
        let said = client.request("initialize", params);
        assert!(said[0].get("result").is_some(), "{said:?}");
        client.notify("initialized", json!({}));
        client
    }

    /// Sends a request and returns all messages of the server.
    pub fn request(&mut self, method: &str, params: Value) -> Vec<Value> {
        self.asked += 1;
        let request = Request { id: self.asked.into(), method: method.to_owned(), params };
        self.say(request.into())
    }

    /// Sends a notification and returns all messages of the server.
    pub fn notify(&mut self, method: &str, params: Value) -> Vec<Value> {
        self.say(Notification { method: method.to_owned(), params }.into())
    }

    fn say(&mut self, message: Message) -> Vec<Value> {
        let mut said = self.server.handle(message);
        said.extend(self.server.idle());
        said.iter().map(|message| serde_json::to_value(message).unwrap()).collect()
    }

    pub fn open(&mut self, uri: &str, text: &str) -> Vec<Value> {
        let document = json!({ "uri": uri, "languageId": "afp", "version": 1, "text": text });
        self.notify("textDocument/didOpen", json!({ "textDocument": document }))
    }
}
