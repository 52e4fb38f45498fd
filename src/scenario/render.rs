//! Diagnostics with the line they are about and a caret under it.

use std::ops::Range;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};

use super::diagnostic::Diagnostic;
use super::fault::Severity;

/// All diagnostics as text for a terminal of `width` columns, each with its snippet. Colour is written as ANSI escapes; `unicode` allows
/// characters outside ASCII for the drawing.
pub fn render(diagnostics: &[Diagnostic], colour: bool, unicode: bool, width: usize) -> String {
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    let decor = if unicode { DecorStyle::Unicode } else { DecorStyle::Ascii };
    let renderer = renderer.decor_style(decor).term_width(width);
    let rendered: Vec<String> = diagnostics.iter().map(|diagnostic| renderer.render(&[group(diagnostic)]) + "\n").collect();
    rendered.join("\n")
}

/// Longest line that is shown (bytes). A longer one is a hostile file, and would only fill the screen.
const MAX_LINE: usize = 2000;

fn group(diagnostic: &Diagnostic) -> Group<'_> {
    let level = if diagnostic.severity == Severity::Error { Level::ERROR } else { Level::WARNING };
    let title = level.primary_title(&diagnostic.message).id(diagnostic.code.describe().0);
    let expected = diagnostic.expected.as_ref().map(|expected| format!("expected {expected}"));
    let mut group = match excerpt(diagnostic) {
        Some((lines, line, span)) => {
            let mut mark = AnnotationKind::Primary.span(span);
            if let Some(expected) = expected {
                mark = mark.label(expected);
            }
            title.element(Snippet::source(lines).line_start(line).path(&diagnostic.file).annotation(mark))
        }
        None => {
            let mut origin = Origin::path(&diagnostic.file);
            if let (Some(line), Some(column)) = (diagnostic.line, diagnostic.column) {
                origin = origin.line(line).char_column(column);
            }
            let group = title.element(origin);
            match expected {
                Some(expected) => group.element(Level::NOTE.message(expected)),
                None => group,
            }
        }
    };
    if let Some(help) = &diagnostic.help {
        group = group.element(Level::HELP.message(help));
    }
    group
}

/// The lines that the diagnostic is about, the number of the first one, and the span in them. Only these are handed to the renderer, whose
/// work grows with the text.
fn excerpt(diagnostic: &Diagnostic) -> Option<(&str, usize, Range<usize>)> {
    let (span, text) = (diagnostic.span.clone()?, &*diagnostic.text);
    let start = text[..span.start].rfind('\n').map_or(0, |index| index + 1);
    let end = text[span.end..].find('\n').map_or(text.len(), |index| span.end + index);
    (end - start <= MAX_LINE).then(|| (&text[start..end], diagnostic.line.unwrap_or(1), span.start - start..span.end - start))
}
