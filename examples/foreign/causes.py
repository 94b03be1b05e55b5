#!/usr/bin/env python3
"""Causes of the errors: the measurements of docs/foreign.md that are not in the tables of orders.py.

    python causes.py [LINKPROOF]      default: target/release/linkproof
"""

import pathlib
import sys
import tempfile

import exudyn_crank_rocker
import mujoco_crank_rocker as four_bar
import mujoco_crank_rocker_runup as runup
import numpy as np
from tables import exact, mapped

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent


class Bench:
    def __init__(self, linkproof, folder):
        self.linkproof, self.path = linkproof, pathlib.Path(folder) / "table.csv"

    def exact(self, name, how, at):
        return exact(self.linkproof, str(ROOT / "scenarios" / f"{name}.toml"), how, at)

    def mapped(self, name, rows):
        four_bar.write(self.path, rows)
        return mapped(self.path, HERE / f"mujoco_{name}.map.toml")

    def off(self, ours, name, at, channel):
        return np.abs(ours - self.exact(name, "time_s", at)[channel]).max()

    def lag(self):
        print("Servo: the crank is late by the integral of the moment, divided by the gain.")
        for gain in (1e4, 1e5, 1e6):
            _, at, ours = self.mapped("crank_rocker", four_bar.simulate(5e-4, gain=gain, since=0.0))
            right = self.exact("crank_rocker", "time_s", at)
            moment = right["drive.torque_N_m"]
            expected = np.concatenate([[0.0], np.cumsum((moment[1:] + moment[:-1]) / 2 * np.diff(at))]) / gain
            lag = right["link.crank.angle_rad"] - ours["link.crank.angle_rad"]
            print(f"  {gain:.0e} N m s/rad: late by {lag.max():.3e} rad, expected {expected.max():.3e}")
            if gain == 1e4:
                rocker = "link.rocker.angle_rad"
                by_angle = self.exact("crank_rocker", "crank_rad", ours["link.crank.angle_rad"])[rocker]
                print(f"    error of the rocker {np.abs(ours[rocker] - right[rocker]).max():.1e} rad at equal times, "
                      f"{np.abs(ours[rocker] - by_angle).max():.1e} rad at equal crank angles")

    def half_a_step(self):
        print("Velocities belong to the middle of the last step.")
        rocker = "link.rocker.omega_rad_s"
        for step in (2e-3, 1e-3, 5e-4):
            _, at, ours = self.mapped("crank_rocker", four_bar.simulate(step))
            off = [self.off(ours[rocker], "crank_rocker", at - shift, rocker) for shift in (0.0, step / 2)]
            print(f"  step {step:g} s: error of the rocker {off[0]:.1e} rad/s at the time of the row, {off[1]:.1e} half a step earlier")

    def servo_force(self):
        print("The servo's force belongs to the previous step.")
        for step in (2e-3, 1e-3, 5e-4):
            rows = four_bar.simulate(step)
            _, at, _ = self.mapped("crank_rocker", rows)
            motor = -np.array([row["motor"] for row in rows])
            off = [self.off(motor, "crank_rocker", at - shift, "drive.torque_N_m") for shift in (0.0, step)]
            print(f"  step {step:g} s: error {off[0]:.1e} N m at the time of the row, {off[1]:.1e} a step earlier")

    def stiffness(self):
        print("Run-up with RK4: error of the x component in joint A, divided by the scale. A part does not vanish with the step.")
        print("In the first row, this part depends on the loop's impedance; in later rows, on its time constant in steps.")
        for choice in ({"stiffness": 0}, *({"stiffness": count} for count in (2, 3, 4, 8)), {"impedance": 0.9}):
            found = []
            for step in (5e-4, 2.5e-4, 1.25e-4):
                _, at, ours = self.mapped("crank_rocker_runup", runup.simulate(step, **choice))
                right = self.exact("crank_rocker_runup", "time_s", at)["joint.A.fx_N"]
                off = np.abs(ours["joint.A.fx_N"] - right) / (np.ptp(right) / 2)
                found.append(f"step {step:g} s: first row {off[0]:.1e}, last {off[-1]:.1e}")
            print(f"  {choice}: " + "; ".join(found))

    def ringing(self):
        print("Exudyn: error of the x component in joint A (N) after the start, every 16 steps of 0.25 ms.")
        for radius in (0.9, 0.6):
            exudyn_crank_rocker.simulate(2.5e-4, self.path, radius=radius)
            how, at, ours = mapped(self.path, HERE / "exudyn_crank_rocker.map.toml")
            off = np.abs(ours["joint.A.fx_N"] - self.exact("crank_rocker", how, at)["joint.A.fx_N"])
            print(f"  spectral radius {radius}: " + " ".join(f"{value:.1e}" for value in off[:9]))


if __name__ == "__main__":
    binary = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "target/release/linkproof")
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(binary, folder)
        for cause in (bench.lag, bench.half_a_step, bench.servo_force, bench.stiffness, bench.ringing):
            cause()
