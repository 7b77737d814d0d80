# SPDX-License-Identifier: MIT
"""The factor of a covariance is found on errors that are drawn with a known one."""
import re
import subprocess
import unittest

from support import SCRIPTS, FolderTest

try:
    import numpy as np
    from scipy.spatial.transform import Rotation
except ImportError:
    np = None

START_S = 1_600_000_000
SIGMAS = [0.02, 0.03, 0.01, 0.004, 0.002, 0.005]


@unittest.skipIf(np is None, "python3-numpy and python3-scipy are not installed")
class CheckCovarianceTest(FolderTest):
    def make_run(self, seed, factor, place=None, start_s=START_S):
        """A body that moves at constant speed; its errors squared are `factor` times as large as
        its covariance says. The whole estimate is moved to `place`."""
        random = np.random.default_rng(seed)
        mixing = random.normal(size=(6, 6))
        covariance = np.diag(SIGMAS) @ (mixing @ mixing.T + np.eye(6)) @ np.diag(SIGMAS)
        truth, estimate, table = [], [], ["t," + ",".join(f"c{i}" for i in range(21))]
        for i in range(31):
            error = random.multivariate_normal(np.zeros(6), factor * covariance)
            true_t = np.array([0.3 * i, 0.01 * i, 0.0])
            true_r = Rotation.from_rotvec([0.0, 0.0, 0.1 * i])
            r = true_r * Rotation.from_rotvec(-error[3:])
            t = true_t - true_r.apply(left_jacobian(-error[3:]) @ error[:3])
            tenths = 10 * start_s + i
            stamp = f"{'-' if tenths < 0 else ''}{abs(tenths) // 10}.{abs(tenths) % 10}00000000"
            truth.append(" ".join([stamp, *map(repr, map(float, [*true_t, *true_r.as_quat()]))]))
            estimate.append(" ".join([stamp, *map(repr, map(float, [*t, *r.as_quat()]))]))
            if place is not None:
                r, t = place * r, place.apply(t) + [1.0, 2.0, 3.0]
            upper = (covariance if i else 0.0 * covariance)[np.triu_indices(6)]
            table.append(",".join([stamp, *map(repr, map(float, upper))]))
        self.write(f"{seed}/result/trajectory.tum", "\n".join(estimate) + "\n")
        self.write(f"{seed}/result/covariance.csv", "\n".join(table) + "\n")
        self.write(f"{seed}/truth.tum", "\n".join(truth) + "\n")
        return f"{self.folder}/{seed}/result={self.folder}/{seed}/truth.tum"

    def check(self, runs, *more):
        return subprocess.run([SCRIPTS / "check_covariance.py", "--every=0.1", *runs, *more],
                              capture_output=True, text=True, check=False)

    def factor_of(self, done):
        self.assertEqual(done.returncode, 0, done.stderr)
        return float(re.search(r"errors are (\S+) times", done.stdout)[1])

    def test_an_optimistic_covariance_is_found_out(self):
        done = self.check([self.make_run(seed, factor=4.0) for seed in range(8)])
        # 8 runs of 20 pairs, which share poses: the factor is known to 7 % (one sigma).
        self.assertAlmostEqual(self.factor_of(done), 4.0, delta=0.8)
        low, high = map(float, re.search(r"times \((\S+) to (\S+)\)", done.stdout).groups())
        self.assertTrue(2.5 < low < high < 5.5, done.stdout)
        self.assertIn("it is optimistic", done.stdout)

    def test_a_pessimistic_one_too(self):
        done = self.check([self.make_run(seed, factor=0.1) for seed in range(8)])
        self.assertIn("it is pessimistic", done.stdout)
        self.assertAlmostEqual(self.factor_of(done), 0.1, delta=0.02)

    def test_a_right_covariance_is_called_right(self):
        done = self.check([self.make_run(seed, factor=1.0) for seed in range(8)])
        self.assertIn("it is right", done.stdout)

    def test_of_one_run_nothing_is_concluded(self):
        done = self.check([self.make_run(1, factor=1.0)])
        self.factor_of(done)
        self.assertIn("One run does not tell", done.stdout)
        self.assertNotRegex(done.stdout, "it is|inf|nan")

    def test_of_one_run_what_cannot_be_chance_is(self):
        for factor, word in ((100.0, "optimistic"), (1e-3, "pessimistic")):
            done = self.check([self.make_run(1, factor)])
            self.factor_of(done)
            self.assertIn(f"outside of the band of a right one: it is {word}.", done.stdout)
            self.assertNotIn("more than chance", done.stdout)

    def test_a_truth_of_another_time_is_named(self):
        result = self.make_run(1, 1.0).partition("=")[0]
        truth = self.make_run(2, 1.0, start_s=START_S + 100).partition("=")[2]
        done = self.check([f"{result}={truth}"])
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, f"{truth} has no time in common with .*/1/result: from the "
                                      "start of the result on, it lasts from 100.000 to 103.000 s, "
                                      "and the result to 3.000 s")

    def test_a_truth_that_cannot_be_interpolated_is_named(self):
        run = self.make_run(1, 1.0)
        path = self.folder / "1/truth.tum"
        lines = path.read_text().splitlines()
        for some in (lines[:1], lines[:3] + lines[2:]):
            path.write_text("\n".join(some) + "\n")
            done = self.check([run])
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("truth.tum needs two poses or more", done.stderr)

    def test_a_truth_with_poses_that_are_none_is_named(self):
        run = self.make_run(1, 1.0)
        path = self.folder / "1/truth.tum"
        lines = path.read_text().splitlines()
        for values in ("nan 0 0 0 0 0 1", "0 0 0 0 0 0 0"):
            stamp = lines[5].split()[0]
            path.write_text("\n".join([*lines[:5], f"{stamp} {values}", *lines[6:]]) + "\n")
            done = self.check([run])
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("truth.tum has poses that are not finite", done.stderr)

    def test_where_the_map_lies_in_the_world_does_not_matter(self):
        here = self.check([self.make_run(1, 1.0)])
        there = self.check([self.make_run(1, 1.0, Rotation.from_rotvec([0.3, -0.2, 0.5]))])
        self.assertAlmostEqual(self.factor_of(here), self.factor_of(there), places=6)

    def test_when_a_run_was_made_does_not_matter(self):
        here = self.check([self.make_run(1, 1.0)])
        before_zero = self.check([self.make_run(1, 1.0, start_s=-2)])
        self.assertEqual(before_zero.stdout, here.stdout)

    def test_poses_may_lie_between_the_control_poses(self):
        run = self.make_run(1, 1.0)
        every = self.check([run], "--begin=1.3")
        path = self.folder / "1/result/covariance.csv"
        head, *lines = path.read_text().splitlines()
        path.write_text("\n".join([head, *lines[::2]]) + "\n")
        self.assertEqual(self.check([run], "--begin=1.3").stdout, every.stdout)
        path.write_text(head + "\n")
        done = self.check([run])
        self.assertEqual(done.returncode, 2)
        self.assertIn("covariance.csv has no covariances", done.stderr)

    def test_runs_that_are_too_short_are_refused(self):
        done = self.check([self.make_run(1, 1.0)], "--apart=5")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("share less time than --apart", done.stderr)


def left_jacobian(theta):
    """V of Exp([rho; theta]): the translation is V rho. By its series: angles are small."""
    cross = np.cross(np.eye(3), theta)  # [theta]x
    return np.eye(3) + cross / 2 + cross @ cross / 6


if __name__ == "__main__":
    unittest.main()
