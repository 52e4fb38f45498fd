//! Diagnostics with the line they are about and a caret under it.

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

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

fn group(diagnostic: &Diagnostic) -> Group<'_> {
    let level = if diagnostic.severity == Severity::Error { Level::ERROR } else { Level::WARNING };
    let title = level.primary_title(&diagnostic.message).id(diagnostic.code.describe().0);
    let mut group = match &diagnostic.span {
        Some(span) => {
            let mut mark = AnnotationKind::Primary.span(span.clone());
            if let Some(expected) = &diagnostic.expected {
                mark = mark.label(format!("expected {expected}"));
            }
            title.element(Snippet::source(&*diagnostic.text).path(&diagnostic.file).annotation(mark))
        }
        None => {
            let group = title.element(annotate_snippets::Origin::path(&diagnostic.file));
            match &diagnostic.expected {
                Some(expected) => group.element(Level::NOTE.message(format!("expected {expected}"))),
                None => group,
            }
        }
    };
    if let Some(help) = &diagnostic.help {
        group = group.element(Level::HELP.message(help));
    }
    group
}
