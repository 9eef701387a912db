"""Display in notebooks."""

import time

import mist


def test_a_material_is_shown_in_little_time_and_space_and_its_texts_are_escaped(tmp_path):
    material = mist.Material("Facet_BRDF_Model", {"sdf.s": 0.2})
    material.check()
    started = time.perf_counter()
    text = material._repr_html_()
    assert time.perf_counter() - started < 0.05
    assert len(text) < 60_000
    assert "<b>0.2</b>" in text and "<svg" in text and "Vacuum wavelength" in text
    path = tmp_path / "a<b>.txt"
    path.write_text("0.4 1 2\n0.8 1 2\n")
    shown = mist.Material("Facet_BRDF_Model", substrate=path)._repr_html_()
    assert "a<b>" not in shown and "a&lt;b&gt;" in shown
