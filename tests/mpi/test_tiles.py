# SPDX-License-Identifier: MIT
"""lsc-mpi tiles writes the files of lsc tiles with any number of processes, and ends cleanly when a process fails.

Usage: test_tiles.py MPIRUN LSC_MPI LSC
"""

import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

MPIRUN, LSC_MPI, LSC = sys.argv[1:4]

TREE = """#n = 3; #set angle 25; #w : !(0.2) F(2) X;
#p : X : * : !(0.08) F({0.5, 0.8}) [ + X ] /(120) [ & X ];
"""
TEMPORARY = re.compile(r"\.lsys-[a-z0-9]+\.tmp$")  # names of unfinished files
RECORD = "tileset.digest"
# Seconds after which a job counts as hanging.
PATIENCE = 120


def options(size=300):
    """Arguments that make tiles of a forest with `size` metres a side."""
    return ["tiles", "tree.lsys", "--placement", "jittered", "--spacing", "4", "--size", str(size), "--heroes", "2",
            "--triangles", "20000", "--error", "0"]


def environment():
    # Allows more processes than processors, also as root, on one machine without a network.
    return dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_btl="self,vader",
                OMPI_MCA_btl_vader_single_copy_mechanism="none")


def files_of(folder):
    """The files of a tileset, without the record of its scene, which is not counted."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*")
            if path.is_file() and path.name != RECORD}


def stamps_of(folder):
    """Inode and time of each complete file, which tell whether it was written again."""
    stamps = {}
    for path in folder.rglob("*"):
        if path.is_file() and path.name != RECORD and not TEMPORARY.search(path.name):
            facts = path.stat()
            stamps[str(path.relative_to(folder))] = (facts.st_ino, facts.st_mtime_ns)
    return stamps


def without_temporaries(files):
    return {name: data for name, data in files.items() if not TEMPORARY.search(name)}


def ranks_of(process):
    """The processes of a job on this machine that run lsc-mpi."""
    ranks = []
    for status in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            text = status.read_text()
        except OSError:
            continue  # the process has ended
        name = text[text.index("(") + 1:text.rindex(")")]
        parent = int(text[text.rindex(")") + 2:].split()[1])
        if name == "lsc-mpi" and parent == process.pid:
            ranks.append(int(status.parent.name))
    return sorted(ranks)


class Tiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        (cls.folder / "tree.lsys").write_text(TREE)
        cls.lsc("-o", "whole")
        cls.whole = files_of(cls.folder / "whole")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    @classmethod
    def lsc(cls, *more):
        subprocess.run([LSC, *options(), *more], cwd=cls.folder, check=True)

    def mpi(self, ranks, *arguments, begin=True):
        """Runs lsc-mpi with a number of processes. `begin`: its arguments begin with options()."""
        words = [*(options() if begin else []), *arguments]
        return subprocess.run([MPIRUN, "-n", str(ranks), LSC_MPI, *words], cwd=self.folder, env=environment(),
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=PATIENCE)

    def assert_message_once(self, run, message):
        self.assertNotEqual(run.returncode, 0)
        self.assertEqual(run.stdout.replace("-", "").count(message), 0)
        self.assertEqual(run.stderr.count(message), 1, run.stderr)
        self.assertEqual(run.stderr.count("lsc-mpi: error:"), 1, run.stderr)

    def test_any_number_of_ranks_writes_the_same_bytes(self):
        self.assertGreater(len(self.whole), 50)
        for ranks in (1, 2, 4):
            run = self.mpi(ranks, "-o", f"ranks{ranks}")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(run.stdout, "")
            self.assertEqual(files_of(self.folder / f"ranks{ranks}"), self.whole)
            lines = re.findall(r"^lsc-mpi: rank \d+ on \S+, \d+ threads?: (\d+) files?, ", run.stderr, re.M)
            self.assertEqual(len(lines), ranks, run.stderr)
            self.assertEqual(sum(map(int, lines)), len(self.whole))
            self.assertIn(f"total of {ranks} rank{'s' if ranks > 1 else ''}: {len(self.whole)} files, ", run.stderr)
        for part in ("2/3", "3/3", "1/3"):
            self.lsc("-o", "parts", "--part", part)
        self.assertEqual(files_of(self.folder / "parts"), self.whole)

    def test_one_process_without_mpirun(self):
        run = subprocess.run([LSC_MPI, *options(), "-o", "alone", "--quiet"], cwd=self.folder, env=environment(),
                             capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))
        self.assertEqual(files_of(self.folder / "alone"), self.whole)

    def test_statistics_are_those_of_all_ranks(self):
        alone = subprocess.run([LSC, *options(), "-o", "stats-alone", "--stats"], cwd=self.folder, check=True,
                               capture_output=True, text=True).stdout
        run = self.mpi(3, "-o", "stats", "--stats", "--threads", "2", "--quiet")
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, alone, ""))

    def end_while_it_writes(self, name, end):
        """Starts a job, ends it by `end` after it has written some files, and resumes the job."""
        size = 3000
        folder = self.folder / name
        reference = self.folder / "large"
        if not reference.exists():
            subprocess.run([LSC, *options(size), "-o", "large"], cwd=self.folder, check=True)
        whole = files_of(reference)
        with subprocess.Popen([MPIRUN, "-n", "4", LSC_MPI, *options(size), "-o", name], cwd=self.folder,
                              env=environment(), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL) as process:
            deadline = time.monotonic() + PATIENCE
            while sum(1 for path in folder.rglob("*.glb")) < 100:
                self.assertIsNone(process.poll(), "the job ended too early")
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.01)
            end(process)
            self.assertNotEqual(process.wait(PATIENCE), 0)
        before = stamps_of(folder)
        self.assertGreater(len(before), 50)
        self.assertLess(len(before), len(whole))
        self.assertNotIn("tileset.json", before)
        self.assertEqual({path: whole[path] for path in before}, without_temporaries(files_of(folder)))

        run = subprocess.run([MPIRUN, "-n", "4", LSC_MPI, *options(size), "-o", name, "--resume"], cwd=self.folder,
                             env=environment(), stdin=subprocess.DEVNULL, capture_output=True, text=True,
                             timeout=PATIENCE)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(without_temporaries(files_of(folder)), whole)
        after = stamps_of(folder)
        self.assertEqual({path: after[path] for path in before}, before, "a complete file was written again")
        self.assertIn(f"total of 4 ranks: {len(whole) - len(before)} files, ", run.stderr)

    def test_a_killed_rank_ends_the_job_which_is_resumed(self):
        def kill_one(process):
            ranks = ranks_of(process)
            self.assertEqual(len(ranks), 4)
            os.kill(ranks[2], signal.SIGKILL)
        self.end_while_it_writes("killed", kill_one)

    def test_a_terminated_job_is_resumed(self):
        self.end_while_it_writes("terminated", lambda process: process.send_signal(signal.SIGTERM))

    def test_an_interrupted_rank_ends_the_job(self):
        def interrupt_one(process):
            os.kill(ranks_of(process)[1], signal.SIGINT)
        self.end_while_it_writes("interrupted", interrupt_one)
        self.assertEqual([name for name in files_of(self.folder / "interrupted") if TEMPORARY.search(name)], [])

    def test_a_folder_that_cannot_be_made(self):
        self.assert_message_once(self.mpi(4, "-o", "tree.lsys/inside"), "cannot make the folder `tree.lsys/inside`")
        self.assert_message_once(self.mpi(4, "-o", "tree.lsys"), "`tree.lsys` is a file; a tileset is a folder")
        self.assert_message_once(self.mpi(4, "-o", "whole"), "`whole` has files already")

    def test_an_error_of_any_rank_is_printed_once(self):
        folder = self.folder / "blocked"
        folder.mkdir()
        (folder / "3").write_text("a file where a folder should be")
        run = self.mpi(4, "-o", "blocked", "--force")
        self.assertEqual(run.returncode, 1)
        self.assert_message_once(run, "cannot make the folder `blocked/3")
        self.assertFalse((folder / "tileset.json").exists())

    def test_a_limit_of_time_ends_the_job(self):
        run = self.mpi(4, *options(20000), "-o", "late", "--max-time", "1", begin=False)
        self.assertEqual(run.returncode, 3, run.stderr)
        self.assertIn("takes longer than 1 s, the limit of `--max-time`", run.stderr)
        self.assertFalse((self.folder / "late" / "tileset.json").exists())

    def test_wrong_command_lines(self):
        for arguments, message in (
                (["tiles", "tree.lsys", "-o", "x", "--part", "1/2"], "lsc-mpi has no `--part`"),
                (["tiles", "tree.lsys", "-o", "x", "--part=1/2"], "lsc-mpi has no `--part`"),
                (["tiles", "tree.lsys", "-o", "x", "--trianglse", "1"], "unknown option `--trianglse`"),
                (["tiles", "tree.lsys"], "--output is missing"),
                (["tiles", "missing.lsys", "-o", "x"], "cannot read `missing.lsys`"),
                (["tiles", "-", "-o", "x"], "standard input reaches one process only"),
                (["export", "tree.lsys", "-o", "tree.glb"], "`export` is not a command of lsc-mpi"),
                ([], "no command is given")):
            run = self.mpi(3, *arguments, begin=False)
            self.assert_message_once(run, message)
            self.assertEqual(run.returncode, 2)
        self.assertFalse((self.folder / "x").exists())

    def test_mistakes_in_a_grammar(self):
        (self.folder / "broken.lsys").write_text("#n = 3; #w : F(;")
        run = self.mpi(3, "tiles", "broken.lsys", "-o", "x", begin=False)
        self.assertEqual(run.returncode, 1)
        self.assertEqual(run.stderr.count("error:"), 1, run.stderr)
        self.assertEqual(run.stderr.count("broken.lsys:1:"), 1, run.stderr)

    def test_help_and_version_are_printed_once(self):
        for arguments, text in ((["--version"], "lsc-mpi "), (["--help"], "Usage: lsc-mpi"),
                                (["tiles", "--help"], "Usage: lsc-mpi tiles")):
            run = self.mpi(3, *arguments, begin=False)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            self.assertEqual(run.stdout.count(text), 1, run.stdout)
            self.assertNotIn("--part", run.stdout)

    def on_two_machines(self, *arguments):
        """Runs a job whose ranks have different current folders."""
        job = [MPIRUN]
        for number, folder in enumerate(("one", "two")):
            (self.folder / folder).mkdir(exist_ok=True)
            job += [":"] * number + ["-n", "1", "-wdir", str(self.folder / folder), LSC_MPI, *arguments]
        return subprocess.run(job, cwd=self.folder, env=environment(), stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=PATIENCE)

    def test_machines_that_differ(self):
        (self.folder / "one").mkdir(exist_ok=True)
        (self.folder / "one" / "tree.lsys").write_text(TREE)
        output = str(self.folder / "shared")
        run = self.on_two_machines(*options(), "-o", output)
        self.assertNotEqual(run.returncode, 0)
        self.assertEqual(run.stderr.count("cannot read `tree.lsys`"), 1, run.stderr)
        self.assertEqual(run.stderr.count("rank 1 cannot plan the tileset, which rank 0 can"), 1, run.stderr)

        (self.folder / "two" / "tree.lsys").write_text(TREE.replace("angle 25", "angle 26"))
        run = self.on_two_machines(*options(), "-o", output, "--force")
        self.assert_message_once(run, "rank 1 would write another tileset than rank 0")

        (self.folder / "two" / "tree.lsys").write_text(TREE)
        run = self.on_two_machines(*options(), "-o", "here")
        self.assert_message_once(run, "rank 1: the folder `here` of rank 0 is not there; all machines must share it")
        self.assertFalse((self.folder / "two" / "here").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
