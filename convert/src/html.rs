//! One page that shows the model in any browser, offline: a viewer and the `.glb` as text.
//!
//! The viewer is `page/viewer.js`, made from three.js by `page/build.sh`. The page's own rules
//! forbid it to load anything from elsewhere.

use std::io::Write;

use crate::base64::{Base64, text_len};
use crate::plan::Plan;
use crate::{Error, Report};

const VIEWER: &str = include_str!("../page/viewer.js");
const HEAD: &str = r#"<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; style-src 'unsafe-inline'; img-src blob: data:; connect-src blob: data:; worker-src blob:">
<style>
html, body { margin: 0; height: 100%; overflow: hidden; background: linear-gradient(#dfe7ee, #f7f8f9); }
canvas { display: block; touch-action: none; outline: none; }
#message { position: fixed; inset: 0; margin: auto; height: 1.5em; text-align: center; font: 16px sans-serif; color: #444; pointer-events: none; }
</style>
<title>"#;
const BODY: &str = r#"</title>
</head>
<body>
<div id="message">Loading…</div>
<script id="model" type="application/octet-stream">"#;
const BETWEEN: &str = "</script>\n<script>\n";
const END: &str = "</script>\n</body>\n</html>\n";

impl Plan<'_> {
    /// Writes the page; the plan must be one for a `.glb`.
    pub(crate) fn write_html(&self, title: &str, out: &mut dyn Write) -> Result<Report, Error> {
        let title = escaped(title);
        for part in [HEAD, &title, BODY] {
            out.write_all(part.as_bytes())?;
        }
        let mut text = Base64::new(&mut *out);
        let mut report = self.write_glb(&mut text)?;
        text.finish()?;
        for part in [BETWEEN, VIEWER, END] {
            out.write_all(part.as_bytes())?;
        }
        let around = [HEAD, &title, BODY, BETWEEN, VIEWER, END].map(|part| part.len() as u64);
        report.counts.bytes = text_len(report.counts.bytes) + around.iter().sum::<u64>();
        Ok(report)
    }
}

/// Text between tags.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;");
    text.replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_viewer_cannot_end_its_own_script() {
        assert!(!VIEWER.to_ascii_lowercase().contains("</script"));
        assert!(!VIEWER.contains("<!--"));
        assert_eq!(escaped("a<b>&amp;"), "a&lt;b&gt;&amp;amp;");
    }
}
