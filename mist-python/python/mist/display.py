"""Pictures and tables of materials for notebooks: HTML and SVG as texts."""

from __future__ import annotations

import html
import math
from typing import TYPE_CHECKING

import numpy as np

from .values import read_value

if TYPE_CHECKING:
    from .material import Material

#: Angles of incidence of a lobe, degrees, with their colours.
LOBES = ((0, "#1b6ca8"), (30, "#2a9d5c"), (60, "#c8553d"))
#: Directions of a lobe.
STEPS = 91


def material_html(material: Material) -> str:
    """The tree of parameters with values, units and meanings, and the lobe in the plane of incidence."""
    rows = []
    for name, text, is_default, kind, unit, doc, _ in material._entries().values():
        indent = 1.2 * name.count(".")
        last = name.rsplit(".", 1)[-1]
        value = html.escape(str(read_value(text, kind)))
        shown = value if is_default else f"<b>{value}</b>"
        rows.append(
            f'<tr><td style="text-align:left;padding-left:{indent + 0.4:.1f}em">'
            f"{html.escape(last)}</td><td>{shown}</td><td>{html.escape(unit)}</td>"
            f'<td style="text-align:left">{html.escape(doc)}</td></tr>'
        )
    return (
        f"<div><b>{html.escape(material.model)}</b> ({material.mode})"
        '<div style="display:flex;align-items:flex-start;gap:1em"><table><thead><tr><th>parameter</th>'
        "<th>value</th><th>unit</th><th>meaning</th></tr></thead><tbody>"
        f"{''.join(rows)}</tbody></table>{lobe_svg(material)}</div></div>"
    )


def lobe_svg(material: Material) -> str:
    """BRDF in the plane of incidence for light at 0, 30 and 60 degrees, radius by the cube root."""
    theta = np.linspace(-math.pi / 2, math.pi / 2, STEPS)[1:-1]
    try:
        incidence = np.radians([angle for angle, _ in LOBES])[:, None]
        values = np.cbrt(np.clip(material.brdf(incidence, abs(theta), np.where(theta < 0, math.pi, 0)), 0, None))
    except Exception:  # noqa: BLE001 - a picture is not worth an error
        return ""
    largest = values.max()
    if not (largest > 0 and np.isfinite(largest)):
        return ""
    parts = ['<line x1="0" y1="110" x2="220" y2="110" stroke="#888"/>']
    for (angle, colour), radii in zip(LOBES, values / largest):
        points = " ".join(
            f"{110 + 100 * r * math.sin(t):.1f},{110 - 100 * r * math.cos(t):.1f}"
            for t, r in zip(theta, radii)
        )
        x, y = 110 - 108 * math.sin(math.radians(angle)), 110 - 108 * math.cos(math.radians(angle))
        parts.append(
            f'<polygon points="110,110 {points}" fill="{colour}" fill-opacity="0.15" '
            f'stroke="{colour}"/><line x1="{x:.1f}" y1="{y:.1f}" x2="110" y2="110" '
            f'stroke="{colour}" stroke-dasharray="3 3"/>'
        )
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" width="220" height="120" viewBox="0 0 220 120">'
        f"<title>BRDF at 0, 30 and 60 degrees, cube root</title>{''.join(parts)}</svg>"
    )
