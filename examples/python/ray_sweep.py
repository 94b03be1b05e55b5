"""A sweep on a cluster of Ray: ray_sweep.py DIRECTORY, which all machines see under the same path."""

import sys

import linkproof
import ray

SHARES = 30


@ray.remote(max_retries=100)
def solved(directory, share):
    return linkproof.resume(directory, shard=(share, SHARES), jobs=1).counts


ray.init()
scenario = linkproof.Scenario.new("four-bar")
vary, figures = {"crank_mm": "20:40", "rocker_mm": "70:90"}, ["max:joint.A.f_N", "transmission_angle_deg"]
scenario.sweep(vary, figures, sobol=3000, part=50, out=sys.argv[1], plan_only=True)
ray.get([solved.remote(sys.argv[1], share) for share in range(1, SHARES + 1)])
print(linkproof.resume(sys.argv[1]).best())
