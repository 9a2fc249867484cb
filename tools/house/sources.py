# SPDX-License-Identifier: Apache-2.0
"""The project's files and the tokens of C++ sources, for the scripts of this folder."""
import os
import re
import subprocess

HOUSE = os.path.dirname(os.path.realpath(__file__))
ROOT = os.path.realpath(os.path.join(HOUSE, "..", ".."))

# Comments, strings, characters and preprocessor lines.
TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"|(?<!\d)\'(?:[^\'\\\n]|\\.)+\'|^#(?:[^\n]*\\\n)*[^\n]*',
                   re.S | re.M)


def tracked(*endings):
    """Paths of the project's files with these endings, from ROOT."""
    listed = subprocess.run([os.path.join(HOUSE, "tracked"), *endings], check=True, text=True, stdout=subprocess.PIPE)
    return listed.stdout.splitlines()


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8", errors="replace") as file:
        return file.read()


def code_only(source):
    """The source with blanks for comments, strings and preprocessor lines; every line stays where it is."""
    return TOKEN.sub(lambda token: re.sub(r"[^\n]", " ", token.group()), source)
