"""tools/install-packages against a pretended Debian: what it installs, what it says, when it gives up."""
import os
import shutil
import stat
import subprocess
import tempfile
import unittest

from support import SOURCE

# Commands that stand in for the system's. `state` holds the names of installed packages, `lists` says whether the package
# lists are there, `calls` records what was run as root.
FAKES = {
    "dpkg-query": """shift 2; shift; grep -qx "$1" "$FAKE/state" && printf 'ii '""",
    "apt-cache": """shift; for p in "$@"; do
  if [ -e "$FAKE/lists" ]; then echo "$p:"; echo "  Candidate: 1.0"; fi; done""",
    "apt-get": """echo "apt-get $*" >> "$FAKE/calls"
[ -e "$FAKE/broken" ] && { echo "E: no network"; exit 100; }
case " $* " in
  *" update "*) touch "$FAKE/lists"; rm -f "$FAKE/stale" ;;
  *" install "*) [ -e "$FAKE/lists" ] && [ ! -e "$FAKE/stale" ] || { echo "E: 404"; exit 100; }
    for p in "$@"; do case $p in -* | install | DPkg*) ;; *) echo "$p" >> "$FAKE/state" ;; esac; done ;;
esac""",
    "id": """cat "$FAKE/uid" """,
    "sudo": """[ -e "$FAKE/sudo" ] || { echo "sudo: no" >&2; exit 1; }; echo sudo >> "$FAKE/calls"; exec "$@" """,
}


def names(kind):
    """kind: needed, optional or tests."""
    with open(os.path.join(SOURCE, "tools/packages.txt"), encoding="utf-8") as file:
        lines = [line for line in file if line.strip() and not line.startswith("#")]
    kind_of = lambda line: next((k for k in ("optional", "tests") if "# " + k in line), "needed")
    return [line.split()[0] for line in lines if kind_of(line) == kind]


class InstallPackages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.bin = os.path.join(self.folder, "bin")
        os.mkdir(self.bin)
        for name, body in FAKES.items():
            self.write("bin/" + name, "#!/bin/sh\n" + body + "\n")
            os.chmod(os.path.join(self.bin, name), stat.S_IRWXU)
        self.write("uid", "0\n")
        self.write("lists", "")
        self.write("calls", "")
        self.installed(names("needed") + names("optional"))

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(text)

    def read(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            return file.read()

    def remove(self, name):
        os.remove(os.path.join(self.folder, name))

    def installed(self, packages):
        self.write("state", "".join(name + "\n" for name in packages))

    def run_script(self, *arguments):
        path = self.bin + ":" + os.environ["PATH"]
        return subprocess.run([os.path.join(SOURCE, "tools/install-packages"), *arguments], capture_output=True, text=True,
                              env={**os.environ, "PATH": path, "FAKE": self.folder}, cwd="/", stdin=subprocess.DEVNULL)

    def test_nothing_missing_nothing_said_nothing_run(self):
        run = self.run_script()
        self.assertEqual((run.returncode, run.stdout, run.stderr, self.read("calls")), (0, "", "", ""))

    def test_every_package_that_is_installed_is_named_and_no_other(self):
        self.installed([name for name in names("needed") + names("optional") if name not in ("cmake", "libfcl-dev")])
        run = self.run_script()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual([line.strip() for line in run.stdout.splitlines() if line.startswith("  ")], ["cmake", "libfcl-dev"])
        calls = self.read("calls")
        self.assertNotIn("update", calls)
        self.assertIn("--no-install-recommends cmake libfcl-dev", calls)
        self.assertEqual(self.run_script().stdout, "")

    def test_package_lists_are_fetched_when_there_are_none_or_stale_ones(self):
        for stale in (False, True):
            with self.subTest(stale=stale):
                self.write("calls", "")
                self.installed([])
                if stale:
                    self.write("stale", "")
                else:
                    self.remove("lists")
                run = self.run_script()
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertEqual(self.read("calls").count(" update"), 1)

    def test_no_install_says_what_is_missing_and_how_to_get_it(self):
        self.installed([name for name in names("needed") if name != "cmake"])
        run = self.run_script("--no-install")
        self.assertEqual(run.returncode, 1)
        self.assertIn("missing packages: cmake", run.stderr)
        self.assertIn("apt-get install", run.stderr)
        self.assertEqual(self.read("calls"), "")

    def test_what_is_optional_stops_nobody(self):
        self.installed(names("needed"))
        run = self.run_script("--no-install")
        self.assertEqual(run.returncode, 0)
        for name in names("optional"):
            self.assertIn(name, run.stderr)

    def test_what_only_tests_need_is_installed_on_request(self):
        self.assertIn("chromium", names("tests"))
        self.assertEqual(self.run_script().returncode, 0)
        self.assertEqual(self.read("calls"), "")
        self.assertEqual(self.run_script("--with-tests").returncode, 0)
        self.assertIn("chromium", self.read("calls"))

    def test_sudo_is_used_by_others_than_root(self):
        self.write("uid", "1000\n")
        self.write("sudo", "")
        self.installed([])
        self.assertEqual(self.run_script().returncode, 0)
        self.assertTrue(self.read("calls").startswith("sudo\n"))

    def test_an_install_that_fails_says_what_is_missing(self):
        self.installed([])
        self.write("broken", "")
        run = self.run_script()
        self.assertEqual(run.returncode, 1)
        self.assertIn("missing packages:", run.stderr)
        self.assertIn("no network", run.stderr)

    def test_wrong_usage(self):
        for script in ("install-packages", "demo", "check"):
            run = subprocess.run([os.path.join(SOURCE, "tools", script), "--instal"], capture_output=True, text=True)
            self.assertEqual(run.returncode, 64)
            self.assertIn("--no-install", run.stderr)

    @unittest.skipUnless(shutil.which("shellcheck"), "no shellcheck here")
    def test_scripts_are_clean(self):
        scripts = [os.path.join(SOURCE, name) for name in
                   ("tools/install-packages", "tools/build", "tools/check", "tools/demo", ".ci/run")]
        run = subprocess.run(["shellcheck", *scripts], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
