//! The picture of a colour table.

use mist_engine::colour::ColourTable;

use super::{
    curves::Graph,
    display::DisplayColours,
    graph,
    page::{MARGIN, TITLE, page, text},
    swatch,
};

/// The picture of a table: swatches of all rows, the lightness over the angle, the spectra.
pub fn plot(table: &ColourTable) -> String {
    let display = DisplayColours::new(table);
    let mut body = String::new();
    text(&mut body, (MARGIN, 32.0), "font-size=\"20\"", &table.material);
    let subtitle = format!(
        "{}, {} observer, {}, {} adaptation; {}",
        table.illuminant,
        table.observer,
        table.space,
        table.adaptation,
        display.white()
    );
    text(&mut body, (MARGIN, 50.0), "fill=\"#555\"", &subtitle);
    let mut y = swatch::draw(table, &display, TITLE, &mut body);
    for graph in [graph::flop(table), graph::spectra(table, &display)].into_iter().flatten() {
        y = graph.draw(y + MARGIN, &mut body);
    }
    page(y, &body)
}

/// Graphs, one below the other, under a title.
pub fn plot_graphs(title: &str, graphs: &[Graph]) -> String {
    let mut body = String::new();
    text(&mut body, (MARGIN, 32.0), "font-size=\"20\"", title);
    let mut y = 48.0;
    for graph in graphs {
        y = graph.draw(y, &mut body) + MARGIN;
    }
    page(y - MARGIN, &body)
}
