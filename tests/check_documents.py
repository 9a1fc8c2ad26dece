"""The documents hold together: links lead somewhere, citations of the theory have their section, the README is short,
the tables of drawers are those that the check of dependencies draws.

usage: check_documents.py SOURCE_FOLDER
"""
import os
import re
import sys
import unittest

SOURCE = sys.argv[1]
CODE = (".hpp", ".cpp", ".py", ".cmake", ".toml", ".sh", "CMakeLists.txt")


def files(ending):
    for folder, inside, names in os.walk(SOURCE):
        inside[:] = [d for d in inside if not d.startswith(".") and d not in ("build", "runs")]
        yield from (os.path.join(folder, name) for name in names if name.endswith(ending))


def text(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def pages():
    """The README and every page of share/doc."""
    return [os.path.join(SOURCE, "README.md"), *files(".md")]


def anchors(page):
    """Names under which the headings of a page can be linked to, as GitHub forms them."""
    headings = re.findall(r"^#+ (.*)$", re.sub(r"```.*?```", "", text(page), flags=re.S), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def document(name):
    return text(os.path.join(SOURCE, "share", "doc", name))


def sections_of(page):
    """Numbers of its headings."""
    return set(re.findall(r"^#+ (\d+(?:\.\d+)?)\.? ", page, re.M))


def theory_sections():
    """The numbered checks of section 15 are cited as 15.1, 15.2, …"""
    theory = document("theory.md")
    sections = sections_of(theory)
    checks = theory[theory.index("\n## 15."):theory.index("\n## 16.")]
    return sections | {f"15.{number}" for number in re.findall(r"^(\d)\. ", checks, re.M)}


def drawers_of(layout, room):
    """[(drawer, what it uses)] of a room's table, in its order."""
    if f"### {room}/\n" in layout:
        table = layout[layout.index(f"### {room}/"):].split("\n### ")[0].split("\n## ")[0]
        return re.findall(r"^\| `(\w+)/` .*\| ([^|]*) \|$", table, re.M)
    return re.findall(rf"^\| `{room}/(\w+)/` .*\| ([^|]*) \|$", layout, re.M)


def named_drawers(uses, above):
    """The drawers that a cell names: a list, "all above", "all above but a, b"."""
    if uses.startswith("all above"):
        return set(above) - set(re.findall(r"\w+", uses.removeprefix("all above but ")))
    return set(re.findall(r"\w+", uses)) - {"and", "the"}


class Documents(unittest.TestCase):
    def test_links_lead_somewhere(self):
        for page in pages():
            for link in re.findall(r"\]\(([^)\s]+)\)", text(page)):
                if link.startswith(("http:", "https:")):
                    continue
                name, _, anchor = link.partition("#")
                target = os.path.normpath(os.path.join(os.path.dirname(page), name)) if name else page
                with self.subTest(page=page, link=link):
                    self.assertTrue(os.path.exists(target))
                    self.assertTrue(not anchor or anchor in anchors(target))

    def find_citations(self, pattern, known):
        """Asserts that the numbers cited are known; returns how many there are."""
        cited = 0
        for path in files(CODE):
            plain = re.sub(r"\n\s*(///|//|#)\s*", " ", text(path))  # a citation may run over a line
            for numbers in re.findall(pattern + r" (\d[\d., to–and]*)", plain):
                for number in re.findall(r"\d+(?:\.\d+)?", numbers):
                    cited += 1
                    with self.subTest(path=path):
                        self.assertIn(number, known)
        return cited

    def test_cited_sections_exist(self):
        pattern = r"[Tt]heory,?(?: sections?)?"
        self.assertGreater(self.find_citations(pattern, theory_sections()), 100)  # 244 when this was written
        pattern = r"interfaces\.md sections?"
        self.assertGreater(self.find_citations(pattern, sections_of(document("interfaces.md"))), 0)

    def test_tables_of_drawers_are_those_that_are_checked(self):
        drawn = text(os.path.join(SOURCE, "tests", "check_dependencies.cmake"))
        layout = document("layout.md")
        for room in ("mesh", "fem", "contact", "solver", "pipelines"):
            drawers = re.search(rf"set\(drawers_{room}([^)]*)\)", drawn)[1].split()
            rows = drawers_of(layout, room)
            with self.subTest(room=room):
                self.assertEqual([name for name, _ in rows], [name for name in drawers if name != "face"])
            for name, uses in rows:
                arrows = re.search(rf"set\(uses_{room}_{name}([^)]*)\)", drawn)
                with self.subTest(room=room, drawer=name):
                    above = [row[0] for row in rows[:[row[0] for row in rows].index(name)]]
                    self.assertEqual(named_drawers(uses, above), set(arrows[1].split() if arrows else ()))

    def test_files_named_in_comments_exist(self):
        """With a folder: from the root, from the room of the file that names it or from share/doc; else anywhere."""
        names = {os.path.basename(path) for path in files((".hpp", ".cpp", ".py", ".md", ".cmake"))}
        named = 0
        for path in files((".hpp", ".cpp")):
            room = os.path.relpath(path, SOURCE).split(os.sep)[0]
            roots = [os.path.join(SOURCE, folder) for folder in ("", room, os.path.join("share", "doc"))]
            for comment in re.findall(r"//.*", text(path)):
                for name in re.findall(r"(?<![\w/<.])(?:\w+/)*\w+\.(?:hpp|cpp|py)\b", comment):
                    named += 1
                    with self.subTest(path=path, name=name):
                        there = any(os.path.exists(os.path.join(root, name)) for root in roots)
                        self.assertTrue(there or ("/" not in name and name in names))
        self.assertGreater(named, 100)

    def test_readme_is_short(self):
        readme = text(os.path.join(SOURCE, "README.md"))
        self.assertLessEqual(len(readme.splitlines()), 150)
        self.assertLessEqual(len(readme.split()), 1500)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
