//! Measures of the page, and text.

use std::fmt::Write as _;

/// Width of the page, in pixels.
pub(super) const WIDTH: f64 = 900.0;
/// Margin of the page.
pub(super) const MARGIN: f64 = 24.0;
/// Height of title and subtitle.
pub(super) const TITLE: f64 = 64.0;

/// Writes text at a point; `attributes` are further attributes of the element.
pub(super) fn text(svg: &mut String, (x, y): (f64, f64), attributes: &str, content: &str) {
    let content = content
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace(|c: char| c.is_control(), " ");
    // Writing to a string cannot fail.
    let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" {attributes}>{content}</text>");
}

/// The picture with this content, whose lower edge is at `bottom`.
pub(super) fn page(bottom: f64, body: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" \
         width=\"{WIDTH}\" height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{body}</svg>\n",
        height = bottom + MARGIN,
    )
}

/// At most `most` indices of `0..count`, evenly spaced, including the first and the last.
pub(super) fn evenly_spaced(count: usize, most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    (0..most).map(|i| i * (count - 1) / (most - 1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spread_keeps_both_ends() {
        assert_eq!(evenly_spaced(3, 5), [0, 1, 2]);
        assert_eq!(evenly_spaced(9, 5), [0, 2, 4, 6, 8]);
        assert_eq!(evenly_spaced(100, 4), [0, 33, 66, 99]);
    }

    #[test]
    fn markup_in_a_name_is_text() {
        let mut svg = String::new();
        text(&mut svg, (0.0, 0.0), "", "<a&b>");
        assert!(svg.contains("&lt;a&amp;b&gt;"), "{svg}");
    }
}
