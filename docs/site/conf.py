"""The documents as a site: see scripts/docs. The Markdown is that of the tree, as it reads on any host of repositories; what only
the site can do is made of it here: the reading order, formulas, the drawing of the rooms, links into the reference."""

import base64
import json
import os
import pathlib
import re
import shutil
import subprocess
import xml.etree.ElementTree
import zlib

from docutils import nodes
from sphinx.util import logging

logger = logging.getLogger(__name__)
root = pathlib.Path(__file__).resolve().parents[2]
work = pathlib.Path(os.environ["COURANT_SITE_WORK"])

project = "Courant"
author = "The Courant authors"
project_copyright = "2026, The Courant authors"
version = release = os.environ["COURANT_VERSION"]
root_doc = "docs/index"
include_patterns = ["README.md", "*/README.md", "docs/*.md", "docs/tour/*.md", "docs/notebooks/*.ipynb"]
source_suffix = {".rst": "restructuredtext", ".md": "markdown", ".ipynb": "markdown"}
exclude_patterns = ["build*", "include", ".git", "runs", "node_modules"]
extensions = ["myst_parser", "sphinx.ext.graphviz"]
myst_heading_anchors = 4
myst_url_schemes = ["http", "https", "mailto", "api"]
graphviz_output_format = "svg"
pygments_style = "friendly"
pygments_dark_style = "native"
highlight_language = "none"
smartquotes = False

html_theme = "furo"
html_title = "Courant"
html_static_path = ["static"]
html_css_files = ["katex/katex.min.css", "site.css"]
html_show_sphinx = False
html_copy_source = False
# Browsers do not fetch excerpts for pages that are opened from a disk.
html_show_search_summary = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#0b6e99", "color-brand-content": "#0b6e99"},
    "dark_css_variables": {"color-brand-primary": "#6cc5e9", "color-brand-content": "#6cc5e9"},
}


class Katex:
    """KaTeX, one process for all formulas of a page that is written."""

    def __init__(self):
        self.process = subprocess.Popen(["node", pathlib.Path(__file__).with_name("katex.js")], text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def html(self, formula, display):
        print(json.dumps({"formula": formula, "display": display}), file=self.process.stdin, flush=True)
        return json.loads(self.process.stdout.readline())


katex = None


def visit_formula(writer, node):
    global katex
    katex = katex or Katex()
    answer = katex.html(node.astext(), isinstance(node, nodes.math_block))
    if "error" in answer:
        logger.warning("formula: %s", answer["error"], location=node)
    element = "div" if isinstance(node, nodes.math_block) else "span"
    writer.body.append(f'<{element} class="formula">{answer.get("html", "")}</{element}>')
    raise nodes.SkipNode


def reading_order(text):
    """The table of contents on the left: the links of each list of docs/index.md, under its heading."""
    parts = []
    for section in text.split("\n## ")[1:]:
        entries = re.findall(r"^(?:[-*]|(\d+\.)) \[([^\]]*)\]\(([^):]+)\.(?:md|ipynb)\)", section, re.M)
        if entries:
            lines = "\n".join(f"{f'{number} {title}'.strip()} <{page}>" for number, title, page in entries)
            parts.append("```{toctree}\n:hidden:\n:caption: " + section.split("\n")[0] + f"\n\n{lines}\n```\n")
    return text + "\n\n" + "\n".join(parts)


def dot(flowchart):
    """A flowchart of Mermaid, of names and arrows alone, for Graphviz."""
    words = [line.split() for line in flowchart.group(1).splitlines()]
    edges = "".join(f'"{line[0]}"' + (f' -> "{line[2]}"' if len(line) == 3 else "") + ";\n" for line in words[1:])
    return ("```{graphviz}\ndigraph {\nrankdir=RL; bgcolor=transparent;\nnode [shape=box style=\"rounded,filled\" fillcolor=\"#eaf3f7\""
            f" color=\"#0b6e99\" fontname=\"DejaVu Sans\" fontsize=11 height=0.35];\nedge [color=\"#0b6e99\" arrowsize=0.7];\n{edges}}}\n```")


def shown(output):
    """What a cell of a notebook printed, or its richest form of a result."""
    if output["output_type"] == "stream":
        return "```text\n" + "".join(output["text"]).rstrip("\n") + "\n```"
    data = {kind: "".join(content) for kind, content in output.get("data", {}).items()}
    if "text/html" in data:
        return "```{raw} html\n<div class=\"output\">" + data["text/html"] + "</div>\n```"
    if "image/svg+xml" in data:
        figure = data["image/svg+xml"][data["image/svg+xml"].index("<svg"):]
        figure = base64.b64encode(figure.encode()).decode()
        return f"```{{raw}} html\n<img class=\"output\" alt=\"figure\" src=\"data:image/svg+xml;base64,{figure}\">\n```"
    return "```text\n" + data.get("text/plain", "") + "\n```"


def notebook_in_markdown(text):
    """A notebook as a page: its words, its code, what it printed and drew."""
    parts = []
    for cell in json.loads(text)["cells"]:
        content = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            content = re.sub(r"\$\$(.+?)\$\$", r"\n```{math}\n\1\n```\n", content, flags=re.S)
            parts.append(re.sub(r"\$([^$\n]+)\$", r"{math}`\1`", content))
        else:
            parts += ["```python\n" + content + "\n```", *map(shown, cell["outputs"])]
    return "\n\n".join(parts) + "\n"


def prepare(app, docname, source):
    if docname.startswith("docs/notebooks/"):
        source[0] = notebook_in_markdown(source[0])
    text = re.sub(r"^```math$", "```{math}", source[0], flags=re.M)
    # A formula in a sentence, as hosts of repositories write it: $`x^2`$.
    text = re.sub(r"``.*?``|\$`([^`\n]+)`\$", lambda found: f"{{math}}`{found[1]}`" if found[1] else found[0], text)
    if docname.startswith("docs/tour/"):  # the formulas of ladders, as `courant tour --markdown` writes them
        text = re.sub(r"^(> )?\$\$(.+)\$\$$", lambda found: "```{math}\n" + found[2] + "\n```", text, flags=re.M)
        code = re.split(r"(^```.*?^```$)", text, flags=re.M | re.S)
        text = "".join(part if i % 2 else re.sub(r"(?<![\\$])\$([^$\n]+)\$", r"{math}`\1`", part) for i, part in enumerate(code))
    text = re.sub(r"^```mermaid\n(.*?)\n```$", dot, text, flags=re.M | re.S)
    folder = (root / docname).parent

    # A link to a folder is one to its page, where it has one.
    def to_page(link):
        target = folder / link.group(2)
        if not target.is_dir():
            return link.group(0)
        return f"[{link.group(1)}]({link.group(2)}/README.md)" if (target / "README.md").exists() else link.group(1)

    text = re.sub(r"\[([^\]\n]+)\]\(([\w./-]+)\)", to_page, text)
    source[0] = reading_order(text) if docname == root_doc else text


def read_reference():
    """Pages of the reference by the names of what they describe."""
    pages = {"": "index.html"}
    for compound in xml.etree.ElementTree.parse(work / "courant.tag").getroot():
        filename = compound.findtext("filename")
        pages[compound.findtext("name").removeprefix("courant::")] = filename if "." in filename else filename + ".html"
    return pages


def link_reference(app, doctree, docname):
    """[Sphere](api:Sphere) leads to its page of the reference."""
    up = "../" * docname.count("/")
    for node in doctree.findall(nodes.reference):
        target = node.get("refuri", "")
        if target.startswith("api:"):
            page = app.config.courant_reference.get(target[4:])
            if page is None:
                logger.warning("the reference has no %s", target[4:], location=node)
            else:
                node["refuri"] = f"{up}api/{page}"
                node["internal"] = True


# A letter and its index as they are typed in running text: S_{k+1}, M_f, T_xM, F^[k].
INDEX = re.compile(r"(?:(?<!\w)|(?<=_\w)|(?<=\bT))([^\W\d_][\u0300-\u036f]?)([_^])(\{[^{}]+\}|\[k\]|\(k\)|[^\W_](?![a-z0-9_]))")


def set_indices(app, doctree):
    for text in list(doctree.findall(nodes.Text)):
        if not isinstance(text.parent, (nodes.literal, nodes.literal_block, nodes.math, nodes.math_block, nodes.raw)):
            parts = INDEX.split(text.astext())
            if len(parts) > 1:
                new = [nodes.Text(parts[0])]
                for letter, kind, index, rest in zip(*[iter(parts[1:])] * 4):
                    raised = nodes.subscript if kind == "_" else nodes.superscript
                    new += [nodes.Text(letter), raised("", index.strip("{}")), nodes.Text(rest)]
                text.parent.replace(text, new)


# The page of scripts/lab, where it has been made: then the site has it, and leads to it.
laboratory = root / "build" / "lab" / "index.html"


def in_laboratory(text):
    """The fragment of an address that opens a text there, see lab/page/share.js."""
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    packed = packer.compress(text.encode()) + packer.flush()
    return "#e=" + base64.urlsafe_b64encode(packed).decode().rstrip("=")


def offer_laboratory(app, doctree, docname):
    """Below each experiment, each chapter of the tour, and at the end of each other page: a link that opens it in the laboratory."""
    if not laboratory.exists():
        return
    address = "../" * docname.count("/") + "lab/index.html"

    def link(fragment, words):
        reference = nodes.reference("", words, refuri=address + fragment, internal=True)
        return nodes.paragraph("", "", reference, classes=["try"])

    chapter = re.fullmatch(r"docs/tour/(\d+)-\w+", docname)
    offered = False
    for block in list(doctree.findall(nodes.literal_block)):
        text = block.astext()
        try:
            is_experiment = "system" in json.loads(text)
        except (ValueError, TypeError):
            is_experiment = False
        if is_experiment:
            words = "Try it: predict, then look" if chapter and not offered else "Try it"
            fragment = f"#chapter={chapter[1]}" if chapter and not offered else in_laboratory(text)
            block.parent.insert(block.parent.index(block) + 1, link(fragment, words))
            offered = True
    sections = list(doctree.findall(nodes.section))
    if not offered and sections:
        sections[0].append(link("", "Try it in the laboratory"))


def bundle_theme(static):
    """Does what Debian's Furo leaves to a web server: its script is a module and its style sheet imports by an absolute path, which
    pages opened from a disk may not; and its dark colours, where the system asks for them, were lost by its compiler."""
    script = static / "scripts" / "furo.js"
    module = script.read_text().split("\n", 1)
    if module[0].startswith("import Gumshoe"):
        script.write_text((static / "scripts" / "gumshoe-patched.js").read_text() + "\n" + module[1])
    style = static / "styles" / "furo.css"
    rules = style.read_text()
    imported = "@import url(/javascript/normalize.css/normalize.css);"
    if imported in rules:
        rules = rules.replace(imported, pathlib.Path("/usr/share/javascript/normalize.css/normalize.css").read_text())
    dark = re.search(r'body\[data-theme="dark"\] (\{[^}]*\})', rules)
    if "prefers-color-scheme" not in rules and dark:
        rules += f'\n@media screen and (prefers-color-scheme: dark) {{ body:not([data-theme="light"]) {dark.group(1)} }}\n'
    style.write_text(rules)


def copy_katex(static):
    target = static / "katex"
    (target / "fonts").mkdir(parents=True, exist_ok=True)
    shutil.copy("/usr/share/javascript/katex/katex.min.css", target)
    for font in pathlib.Path("/usr/share/javascript/katex/fonts").glob("*.woff2"):
        shutil.copy(font, target / "fonts")


def complete(app, exception):
    if exception is None:
        static = pathlib.Path(app.outdir) / "_static"
        bundle_theme(static)
        copy_katex(static)
        if laboratory.exists():
            (pathlib.Path(app.outdir) / "lab").mkdir(exist_ok=True)
            shutil.copy(laboratory, pathlib.Path(app.outdir) / "lab")


def setup(app):
    app.add_config_value("courant_reference", read_reference(), "env")
    app.add_html_math_renderer("katex", (visit_formula, None), (visit_formula, None))
    app.connect("source-read", prepare)
    app.connect("doctree-resolved", link_reference)
    app.connect("doctree-resolved", offer_laboratory)
    app.connect("doctree-read", set_indices)
    app.connect("build-finished", complete)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


html_math_renderer = "katex"
