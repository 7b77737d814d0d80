# SPDX-License-Identifier: MIT
"""HTML pages that hold everything they show: styles inline, pictures as data URIs."""
import base64
import io
import pathlib
import re

import jinja2
import markupsafe
import PIL.Image

from trajlo_report import names, theme

TYPES = {".svg": "image/svg+xml", ".png": "image/png"}


def data_uri(path):
    """A picture as text that can stand in the place of its address."""
    path = pathlib.Path(path)
    return f"data:{TYPES[path.suffix]};base64,{base64.b64encode(path.read_bytes()).decode()}"


def compact_uri(path, most_pixels=1000):
    """The same as WebP, a fifth of the size: for pages with the pictures of hundreds of runs."""
    stream = io.BytesIO()
    with PIL.Image.open(path) as image:
        image = image.convert("RGB")
        image.thumbnail((most_pixels, 2 * most_pixels))
        image.save(stream, "WEBP", quality=80)
    return f"data:image/webp;base64,{base64.b64encode(stream.getvalue()).decode()}"


def number(value, digits=3):
    """A number for people: fixed digits where that says something, else three significant ones."""
    if value is None or isinstance(value, jinja2.Undefined):
        return "–"
    if isinstance(value, bool) or isinstance(value, str):
        return str(value)
    if isinstance(value, int):
        return f"{value}"
    if value != value:
        return "–"
    if value != 0 and (abs(value) < 0.5 * 10**-digits or abs(value) >= 1e6):
        return f"{value:.3g}"
    return f"{value:.{digits}f}"


def setting(value):
    """A value as one would write it in a configuration."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:g}" if isinstance(value, float) else str(value)


def breakable(text):
    """Lines of long keys break where their words end."""
    return markupsafe.Markup(re.sub(r"([._=])", r"\1<wbr>", str(markupsafe.escape(text))))


def flatten(tree, prefix=""):
    """Nested mappings and lists as rows (dotted key, value)."""
    rows = []
    for key, value in tree.items() if isinstance(tree, dict) else enumerate(tree, 1):
        name = f"{prefix}{key}"
        if isinstance(value, list) and not any(isinstance(item, (dict, list)) for item in value):
            rows.append((name, "  ".join(str(item) for item in value)))
        elif isinstance(value, (dict, list)):
            rows += flatten(value, f"{name}.")
        else:
            rows.append((name, value))
    return rows


def render(template, **values):
    """The text of templates/<template> with `values` filled in."""
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("trajlo_report"), autoescape=True, trim_blocks=True,
        lstrip_blocks=True, undefined=jinja2.ChainableUndefined)
    environment.filters.update(
        number=number, setting=setting, data_uri=data_uri, compact_uri=compact_uri,
        breakable=breakable, title=names.title, counted=names.counted)
    return environment.get_template(template).render(theme=theme, decimals_of=names.decimals_of,
                                                     **values)
