#!/usr/bin/env python3
"""Prints a header with its comments as Doxygen reads them: doxygen_comments.py HEADER

The comments of the headers are plain: // before what they describe, or behind it. Here they become /** */ and ///<, with what
Doxygen would obey made plain text, and tables and formulas on lines of their own kept as they are typed.
"""

import re
import sys

SCOPE = re.compile(r"\s*(public|protected|private|struct|class|enum|union|namespace|extern)\b")


def plain(text):
    """Text without commands of Doxygen, and without links from words that are classes too (%Definition), but for those of
    several humps, which mean the class; what stands between backticks is code already."""
    parts = text.split("`")
    for i in range(0, len(parts), 2):
        part = re.sub(r"([\\@#<>%&$])", r"\\\1", parts[i]).replace("*", "&lowast;")
        parts[i] = re.sub(r'(?<![\w:"])([A-Z][a-z]+)(?![\w(]|::)', r"%\1", part)
    return "`".join(parts)


def documented(comment):
    """The lines of a comment, without //, as Doxygen should read them."""
    result, literal, in_list, blank = [], False, False, 0
    for line in comment:
        if not line:
            blank += 1
            continue
        is_item = re.match(r" (\d+\.|[-*]) ", line) is not None
        in_list = is_item or (in_list and line.startswith("   "))
        wants_literal = line.startswith("   ") and not in_list
        if literal and not wants_literal:
            result.append(" @endverbatim")
        result += [""] * blank
        if wants_literal and not literal:
            result.append(" @verbatim")
        literal, blank = wants_literal, 0
        if is_item:
            line = line.replace(" * ", " - ", 1)
        result.append(line.replace("*/", "* /") if literal else plain(line))
    return result + ([" @endverbatim"] if literal else [])


def convert(lines):
    above = []  # (indentation, line) of the code that a line stands in
    i = 0
    while i < len(lines):
        line = lines[i]
        indentation = len(line) - len(line.lstrip())
        if line.strip():
            while above and above[-1][0] >= indentation:
                above.pop()
        in_scope = not above or SCOPE.match(above[-1][1])
        if line.strip().startswith("//"):
            comment = []
            while i < len(lines) and lines[i].strip().startswith("//"):
                comment.append(lines[i].strip()[2:])
                i += 1
            # What stands alone, before an empty line, describes nothing.
            alone = i < len(lines) and not lines[i].strip() and not in_first(comment, lines)
            space = " " * indentation
            if in_scope and not alone:
                print(space + ("/** @file\n" if in_first(comment, lines) else "/**"))
                for text in documented(comment):
                    print(space + text)
                print(space + "*/")
            else:
                for text in comment:
                    print(space + "//" + text)
            continue
        if line.strip():
            above.append((indentation, line))
        behind = re.match(r"^(.*[;,\w}])\s+// (.*)$", line)
        if behind and in_scope and '"' not in behind[1]:
            line = f"{behind[1]}  ///< {plain(behind[2])}"
        print(line)
        i += 1


def in_first(comment, lines):
    return bool(lines) and lines[0].strip()[2:] == comment[0] and lines[0].startswith("//")


with open(sys.argv[1], encoding="utf-8") as header:
    convert(header.read().split("\n"))
