#!/usr/bin/env python3
"""Holds every #include of src/, include/ and tools/ to the table in modules.txt and names the offending line."""
import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("MAMO_SOURCE_DIR", Path(__file__).resolve().parents[2]))
TABLE = Path(__file__).resolve().with_name("modules.txt")
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')
SOURCES = (".hpp", ".h", ".cpp", ".cc", ".hxx", ".inl")


def read_table(text):
    """-> ({module: set of direct dependencies}, {include prefix: set of modules})."""
    modules, third_party = {}, {}
    for line in text.splitlines():
        line = line.split("#")[0].strip()
        if not line:
            continue
        name, _, rest = line.partition(":")
        if name.startswith("third-party "):
            third_party[name.split()[1]] = set(rest.split())
        else:
            modules[name.strip()] = set(rest.split())
    return modules, third_party


def closure(modules):
    """-> {module: everything it may include}. A cycle or an unknown name is an error: the graph is layered."""
    allowed = {}

    def visit(module, path):
        if module in path:
            raise ValueError("modules.txt: cycle " + " -> ".join(path + [module]))
        if module not in modules:
            raise ValueError(f"modules.txt: {path[-1]} names the unknown module {module}")
        if module not in allowed:
            reach = {module}
            for used in sorted(modules[module]):
                reach |= visit(used, path + [module])
            allowed[module] = reach
        return allowed[module]

    for module in modules:
        visit(module, [])
    return allowed


def owner(relative):
    """-> the module of a file, 'tools' for the mains."""
    parts = relative.parts
    if parts[0] == "tools":
        return "tools"
    return parts[2] if parts[0] == "include" else parts[1]


def target_module(root, path, quote, name):
    """-> the module an include reaches for; None for system and third-party headers and for neighbours."""
    if name.startswith("mamo/"):
        parts = name.split("/")
        return parts[1] if len(parts) > 2 else "(no module)"
    if quote == '"':
        if (path.parent / name).exists():
            resolved = (path.parent / name).resolve()
            for base in ("src", "include", "tools"):
                if resolved.is_relative_to(root.resolve() / base):
                    return owner(resolved.relative_to(root.resolve()))
        first = name.split("/")[0]
        if "/" in name and (root / "src" / first).is_dir():
            return first
    return None


def violations(root, table_text):
    modules, third_party = read_table(table_text)
    allowed = closure(modules)
    allowed["tools"] = set(modules) | {"tools"}
    found = []
    for base in ("include/mamo", "src", "tools"):
        for path in sorted((root / base).rglob("*")):
            if path.suffix not in SOURCES:
                continue
            relative = path.relative_to(root)
            module = owner(relative)
            if module not in allowed:
                found.append(f"{relative}:1: '{module}' is no module of tests/project/modules.txt")
                continue
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                match = INCLUDE.match(line)
                if not match:
                    continue
                place, name = f"{relative}:{number}", match.group(2)
                target = target_module(root, path, match.group(1), name)
                if target is not None and target not in allowed:
                    found.append(f"{place}: includes {name}, whose module '{target}' is unknown")
                elif target is not None and target not in allowed[module]:
                    found.append(f"{place}: {module} may not use {target} ({name})")
                for prefix, users in third_party.items():
                    if not name.startswith(prefix):
                        continue
                    if base == "include/mamo":
                        found.append(f"{place}: public headers show no third-party header ({name})")
                    elif module not in users:
                        found.append(f"{place}: {module} may not use {name} (only {', '.join(sorted(users))})")
    return found


class ModuleGraph(unittest.TestCase):
    def test_every_include_of_the_project_is_allowed(self):
        found = violations(ROOT, TABLE.read_text())
        self.assertEqual(found, [], "\n" + "\n".join(found))

    def test_the_scan_sees_the_project(self):
        self.assertGreater(len(list((ROOT / "include/mamo").rglob("*.hpp"))), 10)
        self.assertGreater(len(list((ROOT / "src").rglob("*.cpp"))), 5)


class PlantedViolations(unittest.TestCase):
    TABLE = "common:\nmodel: common\nphysics: model\nverify: physics\nthird-party fcl/: verify\n"

    def scan(self, files):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name, text in files.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            return violations(root, self.TABLE)

    def test_what_is_allowed_passes(self):
        self.assertEqual(self.scan({"src/verify/a.cpp": '#include <fcl/fcl.h>\n#include "mamo/model/x.hpp"\n',
                                    "src/model/b.cpp": '#include <vector>\n#include "b_private.hpp"\n',
                                    "tools/mamo/main.cpp": '#include "mamo/verify/v.hpp"\n'}), [])

    def test_an_upward_include_is_named_with_file_and_line(self):
        self.assertEqual(self.scan({"src/model/b.cpp": '// text\n\n#include "mamo/physics/world.hpp"\n'}),
                         ["src/model/b.cpp:3: model may not use physics (mamo/physics/world.hpp)"])

    def test_a_private_header_of_another_module_is_found(self):
        self.assertEqual(self.scan({"src/common/c.cpp": '#include "verify/replay.hpp"\n', "src/verify/replay.hpp": ""}),
                         ["src/common/c.cpp:1: common may not use verify (verify/replay.hpp)"])

    def test_a_relative_detour_is_found(self):
        self.assertEqual(self.scan({"src/common/c.cpp": '#include "../verify/replay.hpp"\n', "src/verify/replay.hpp": ""}),
                         ["src/common/c.cpp:1: common may not use verify (../verify/replay.hpp)"])

    def test_a_third_party_header_in_public_is_found(self):
        self.assertEqual(self.scan({"include/mamo/verify/v.hpp": "#pragma once\n#include <fcl/fcl.h>\n"}),
                         ["include/mamo/verify/v.hpp:2: public headers show no third-party header (fcl/fcl.h)"])

    def test_a_third_party_header_in_the_wrong_module_is_found(self):
        self.assertEqual(self.scan({"src/model/m.cpp": "# include <fcl/fcl.h>\n"}),
                         ["src/model/m.cpp:1: model may not use fcl/fcl.h (only verify)"])

    def test_unknown_modules_are_found_on_both_sides(self):
        found = self.scan({"src/magic/m.cpp": "", "src/model/n.cpp": '#include "mamo/magic/m.hpp"\n'})
        self.assertEqual(found, ["src/magic/m.cpp:1: 'magic' is no module of tests/project/modules.txt",
                                 "src/model/n.cpp:1: includes mamo/magic/m.hpp, whose module 'magic' is unknown"])

    def test_a_cyclic_table_is_an_error(self):
        with self.assertRaises(ValueError):
            closure({"a": {"b"}, "b": {"a"}})


class VerifyStandsAlone(unittest.TestCase):
    """The judge shares no evaluation code with the planners: it reads the constraints for itself."""

    FORBIDDEN = ("mamo/physics/evaluation.hpp", "constraint_watch", "mamo/collision/collision_checker.hpp",
                 "mamo/lattice/", "mamo/push/", "mamo/selsim/", "mamo/em4m/", "mamo/search/")

    def test_no_evaluation_header_of_the_planners_is_included(self):
        files = [p for base in ("src/verify", "include/mamo/verify") for p in sorted((ROOT / base).rglob("*.[ch]pp"))]
        self.assertTrue(files, "no sources of verify")
        for path in files:
            for number, line in enumerate(path.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                if match:
                    for name in self.FORBIDDEN:
                        self.assertNotIn(name, match.group(2), f"{path.relative_to(ROOT)}:{number}")


if __name__ == "__main__":
    sys.exit(unittest.main())
