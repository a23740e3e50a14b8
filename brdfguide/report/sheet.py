"""How the report page looks, and figures put into it: light and dark, phone and paper; nothing from the network."""

import re
from base64 import b64encode
from html import escape

from .figures import style

CSS = """
:root{--paper:#fff;--ink:#1f2328;--soft:#57606a;--rule:#c9ced6;--card:#f6f7f9;--accent:#005a91;--bad:#a33b00;
 --s0:#0072B2;--s1:#D55E00;--s2:#009E73;--s3:#CC79A7;--s4:#E69F00;--s5:#56B4E9;--s6:#8A6D3B;--s7:#777777}
@media (prefers-color-scheme:dark){:root{
 --paper:#14171a;--ink:#e8eaed;--soft:#a7b0ba;--rule:#4a525c;--card:#1e2327;--accent:#7cc4f5;--bad:#ffa36b;
 --s0:#5291FF;--s1:#FF8A3D;--s2:#35C79A;--s3:#E8A0C8;--s4:#F2B632;--s5:#9AD2F6;--s6:#C9A86A;--s7:#A8A8A8}}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0 auto;max-width:60rem;padding:1.2rem 1rem 3rem;background:var(--paper);color:var(--ink);
 font:1rem/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"DejaVu Sans",sans-serif;overflow-wrap:break-word}
header p,figcaption,.soft{color:var(--soft)}
h1{font-size:1.35rem;line-height:1.25;margin:0 0 .2rem}
h2{font-size:1.1rem;margin:2.2rem 0 .6rem;padding-top:.7rem;border-top:1px solid var(--rule)}
h3{font-size:1rem;margin:1.2rem 0 .3rem}
p{margin:.4rem 0}
a{color:var(--accent)}
.answer{background:var(--card);border-left:4px solid var(--accent);padding:.8rem 1rem;margin:1rem 0}
.answer strong{font-size:1.5rem;line-height:1.2;display:block}
.wide{overflow-x:auto;margin:.6rem 0}
table{border-collapse:collapse;font-size:.9rem}
th,td{padding:.25rem .5rem .25rem 0;text-align:left;vertical-align:top;border-bottom:1px solid var(--rule)}
th{font-weight:600}
td:last-child{overflow-wrap:break-word;min-width:6.2rem}
td.n,th.n{text-align:right}td.n{font-variant-numeric:tabular-nums;white-space:nowrap}
td:nth-child(2){white-space:nowrap}
tr.pick td{font-weight:600}
.bar{display:inline-block;height:.6em;background:var(--accent);vertical-align:baseline;min-width:2px}
.floor{position:relative;height:1.2em}
.floor .mark{position:absolute;top:0;width:2px;height:1.2em;background:var(--ink)}
ul{margin:.3rem 0;padding-left:1.2rem}
li{margin:.25rem 0}
.warning::marker,.error::marker{color:var(--bad)}
code{font-family:ui-monospace,"DejaVu Sans Mono",Menlo,Consolas,monospace;font-size:.88em}
code.whole{display:inline-block;max-width:100%}
figure{margin:1rem 0}
figure svg{display:block;width:100%;height:auto;min-width:34rem}
figure img{display:block;max-width:100%;height:auto}
.looks{display:flex;flex-wrap:wrap;gap:1rem;margin:.6rem 0}
.looks>div{flex:0 1 16rem;min-width:0;font-size:.88rem}
.looks b{display:block}
.looks img{margin-bottom:.3rem;border-radius:3px;background:var(--card)}
figcaption{font-size:.88rem;margin-top:.3rem}
@media screen and (max-width:36rem){
 figure:has(svg) figcaption::before{content:"Wider than the screen: swipe it sideways. "}}
@media screen and (max-width:36rem){
 .fold,.fold tbody{display:block}.fold thead{display:none}
 .fold tr{display:flex;flex-wrap:wrap;gap:0 .8rem;padding:.35rem 0;border-bottom:1px solid var(--rule)}
 .fold td,.fold td:last-child{border:0;padding:0;min-width:0}.fold td:empty{display:none}
 .fold td[data-is]::before{content:attr(data-is) " ";color:var(--soft);font-weight:400}}
nav{font-size:.9rem;margin:.8rem 0}
nav a{margin-right:.9rem;white-space:nowrap}
dl{display:grid;grid-template-columns:minmax(7rem,max-content) 1fr;gap:.2rem 1rem;font-size:.92rem}
dt{color:var(--soft)}dd{margin:0;min-width:0}
@media print{:root{--paper:#fff;--ink:#000;--soft:#444;--rule:#bbb;--card:#f4f4f4;--accent:#005a91;--bad:#a33b00;
 --s0:#0072B2;--s1:#D55E00;--s2:#009E73;--s3:#CC79A7;--s4:#E69F00;--s5:#56B4E9;--s6:#8A6D3B;--s7:#777777}
 body{max-width:none;font-size:10pt;padding:0}nav{display:none}.wide{overflow:visible}
 figure svg{min-width:0}figure,tr,li,.floor{break-inside:avoid}h2,h3{break-after:avoid}
 body{-webkit-print-color-adjust:exact;print-color-adjust:exact}}
"""


def html_page(title: str, body: str, data: str) -> str:
    """A whole page; `data` is JSON for programs, never run."""
    data = data.replace("<", "\\u003c")  # neither an end of the element nor a beginning of a comment
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width,initial-scale=1">'
        '<meta name="color-scheme" content="light dark"><link rel="icon" href="data:,">'
        f"<title>{title}</title><style>{CSS}</style></head><body>\n{body}\n"
        f'<script type="application/json" id="result">{data}</script>\n</body></html>\n'
    )


def inline(svg: bytes, number: int) -> str:
    """A figure as part of a page: it takes the page's colours and width, and its names meet no other figure's."""
    text = svg.decode()
    text = text[text.index("<svg") :]
    text = re.sub(r'<svg([^<>]*?) width="[^"<>]*"', r"<svg\1", text, count=1)
    text = re.sub(r'<svg([^<>]*?) height="[^"<>]*"', r"<svg\1", text, count=1)
    before, metadata, rest = text.partition("<metadata>")
    text = before + rest.partition("</metadata>")[2] if metadata else text
    text = re.sub(r'\bid="', f'id="f{number}-', text)
    text = re.sub(r'href="#', f'href="#f{number}-', text)
    text = text.replace("url(#", f"url(#f{number}-")
    series = [(colour.lower(), f"s{place}") for place, colour in enumerate(style.COLOURS)]
    for colour, name in ((style.INK, "ink"), (style.RULE, "rule"), (style.PAPER, "paper"), *series):
        text = re.sub(f"(fill|stroke): {colour}", rf"\1: var(--{name})", text)
    return text.replace("<svg", '<svg role="img"', 1)


def picture(figure: style.PageFigure, number: int) -> str:
    """A figure, ready to stand in a page with its caption."""
    content, caption = figure
    if isinstance(content, bytes):
        named = inline(content, number).replace("<svg", f'<svg aria-label="{escape(caption, quote=True)}"', 1)
        shown = f'<div class="wide">{named}</div>'
    else:
        shown = f'<div class="looks">{"".join(_look(*each) for each in content)}</div>'
    return f"<figure>{shown}<figcaption>{escape(caption)}</figcaption></figure>"


def _look(png: bytes, name: str, words: str) -> str:
    image = f'<img alt="{escape(name, quote=True)}" src="data:image/png;base64,{b64encode(png).decode()}">'
    more = f' <span class="soft">{escape(words)}</span>' if words else ""
    return f"<div>{image}<b>{escape(name)}</b>{more}</div>"
