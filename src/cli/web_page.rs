//! A recording as a page: rerun's web viewer, which the program carries, and the file, both served to this machine alone.

use std::fs::File;
use std::net::Ipv4Addr;
use std::path::{Path, PathBuf};

use re_web_viewer_server::WebViewerData;
use tiny_http::{Header, Request, Response, Server};

/// Where the page finds the recording.
const RECORDING: &str = "/recording.rrd";

/// A page that is served as long as somebody answers its requests.
pub(super) struct WebPage {
    server: Server,
    viewer: WebViewerData,
    recording: PathBuf,
}

impl WebPage {
    /// Takes a port of this machine that no other machine reaches; 0 takes any that is free.
    ///
    /// # Errors
    /// In words, when the port is taken.
    pub fn open(recording: &Path, port: u16) -> Result<Self, String> {
        let server = Server::http((Ipv4Addr::LOCALHOST, port))
            .map_err(|error| format!("the page cannot be served at port {port}: {error}: choose another one with --web-port"))?;
        let viewer = WebViewerData::load(None).map_err(|error| error.to_string())?;
        Ok(Self { server, viewer, recording: recording.to_owned() })
    }

    /// Its address.
    pub fn address(&self) -> String {
        let host = self.server.server_addr();
        format!("http://{host}/?url=http%3A%2F%2F{}{}", host.to_string().replace(':', "%3A"), RECORDING.replace('/', "%2F"))
    }

    /// Answers requests until the program is ended.
    pub fn serve(&self) {
        // A browser that goes away in the middle of an answer is no fault.
        self.server.incoming_requests().for_each(|request| drop(self.answer(request)));
    }

    fn answer(&self, request: Request) -> std::io::Result<()> {
        let path = request.url().split('?').next().unwrap_or_default().to_owned();
        if path == RECORDING {
            let Ok(file) = File::open(&self.recording) else { return request.respond(Response::empty(404)) };
            return request.respond(Response::from_file(file).with_header(header("Content-Type", "application/octet-stream")));
        }
        let Some((kind, content)) = self.part(&path) else { return request.respond(Response::empty(404)) };
        // A large answer is sent in pieces, without its length: the page takes it from this, for its progress bar.
        let length = header("rerun-final-length", &content.len().to_string());
        request.respond(Response::from_data(content).with_header(header("Content-Type", kind)).with_header(length))
    }

    /// A part of the viewer, with its media type.
    fn part(&self, path: &str) -> Option<(&'static str, &[u8])> {
        match path {
            "/" | "/index.html" => Some(("text/html", self.viewer.index_html())),
            "/favicon.ico" => Some(("image/x-icon", self.viewer.favicon())),
            "/apple-touch-icon.png" => Some(("image/png", self.viewer.apple_touch_icon())),
            "/sw.js" => Some(("text/javascript", self.viewer.sw_js())),
            "/re_viewer.js" => Some(("text/javascript", self.viewer.viewer_js())),
            "/re_viewer_bg.wasm" => Some(("application/wasm", self.viewer.viewer_wasm())),
            _ => None,
        }
    }
}

fn header(name: &str, value: &str) -> Header {
    Header::from_bytes(name, value).expect("names and values of headers are plain ASCII")
}
