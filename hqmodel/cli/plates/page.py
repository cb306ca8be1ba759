"""The page that shows all figures and explains each: one HTML file, with nothing in it that is fetched from elsewhere."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from hqmodel.files import Builtin

_STYLE = """
:root { color-scheme: light; }
body { margin: 0 auto; max-width: 70rem; padding: 1rem; font: 1.05rem/1.55 Georgia, "Times New Roman", serif;
  color: #262628; background: #fbfaf8; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 1.5rem 0 .5rem; }
h2 { font-size: 1.15rem; margin: 0 0 .3rem; }
a { color: #2b5d86; }
code { font: .88em ui-monospace, Consolas, monospace; background: #efedea; padding: .1em .3em; border-radius: .2em;
  overflow-wrap: anywhere; }
figure { margin: 2rem 0; padding: 1rem; background: #fff; border: 1px solid #e4e1dc; border-radius: .6rem; }
.plate { overflow-x: auto; }
img { display: block; height: auto; width: 100%; min-width: 34rem; }
figcaption { max-width: 46rem; margin-top: .8rem; }
figcaption p { margin: .3rem 0; }
nav { font-size: .95rem; }
"""
_INTRO = """
<p>A hyperquadric is a body bounded by one equation, a sum of powers |<i>h</i>|<sup><i>γ</i></sup> of affine functions <i>h</i>,
one for each strip of space that it lies in. Exponents <i>γ</i> pull it flat against its strips or let it go round; the slice
<i>t</i> moves through a body of more dimensions; and sums of exponentials, cut at a level <i>w</i>, join such bodies and carve
them. The figures are those of A. J. Hanson, <i>Hyperquadrics: Smoothly deformable shapes with convex polyhedral bounds</i>,
Computer Vision, Graphics, and Image Processing 44, 191&ndash;210 (1988), drawn anew. Each one is a preset to play with.</p>
"""


def page(shown: Sequence[tuple[Builtin, str, tuple[int, int]]], presets: str) -> str:
    """The page of these figures, each with its picture's name and size; `presets` is the folder that holds their presets."""
    links = " · ".join(f'<a href="#{preset.name}">{escape(preset.title.partition(":")[0])}</a>' for preset, _, _ in shown)
    figures = "\n".join(_figure(preset, picture, size, presets) for preset, picture, size in shown)
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>Hyperquadrics, figure by figure</title>\n<style>{_STYLE}</style>\n</head>\n<body>\n"
        f"<h1>Hyperquadrics, figure by figure</h1>{_INTRO}<nav>{links}</nav>\n{figures}\n</body>\n</html>\n"
    )


def _figure(preset: Builtin, picture: str, size: tuple[int, int], presets: str) -> str:
    number, _, words = preset.title.partition(": ")
    return f"""<figure id="{preset.name}">
<div class="plate"><img src="{picture}" alt="{escape(preset.title)}" width="{size[0]}" height="{size[1]}" loading="lazy"></div>
<figcaption>
<h2>{escape(number)}. {escape(words[:1].upper() + words[1:])}</h2>
<p>{escape(preset.description)}</p>
<p>Preset: <a href="{presets}/{preset.path.name}">{preset.path.name}</a>; <code>hqmodel {preset.name}</code> opens it,
<code>hqmodel animate {preset.name} -o {preset.name}.gif</code> sets it in motion.</p>
</figcaption>
</figure>"""
