"""The plan of a large sweep on a cluster, simulated from measured numbers: scale_plan.py CASES WORKERS [SHARES ...]

Workers start one after the other, the scheduler hands out shares one by one, and workers die at random.
docs/scale.md says how each number was measured.
"""

import heapq
import random
import sys

#: Time of a case (s) on one thread: in batches, and read and solved one by one.
CASE = {"in batches": 4.1e-6, "one by one": 300e-6}
#: Bytes of a case in the table: an index, two varied numbers, two figures, state and reason.
BYTES = 31
#: Time that each share costs its worker in addition to its cases (s), and time that it costs scheduler and client (s).
SHARE, SCHEDULER = 0.006, 0.003
#: Time until the first worker takes a share, and between the starts of two workers (s). Not measured: they depend on the cluster.
START, NEXT = 20.0, 0.05
#: Mean life of a worker (s), and time until a dead one is replaced. Not measured either.
LIFE, REPLACED = 4 * 3600.0, 60.0
#: Merging the parts: copied bytes per second, additional time per part (s), and bytes of memory per part.
#: The last number is the time per case (s) of a pass over the table.
COPY, PART, MEMORY, PASS = 300e6, 3.4e-3, 7800, 190e-9


def usual_part(cases):
    """Number of cases of a part, as in `linkproof sweep`."""
    return min(max(cases // 64, 64), max(20_000, min(cases // 10_000, 1_000_000)))


def simulated(shares, work, workers, start=START, seed=1):
    """Time (s) until all shares of `work` seconds each are done, and number of workers that died."""
    chance = random.Random(seed)
    free = [(start + NEXT * number, number) for number in range(workers)]
    ends = [begin + chance.expovariate(1 / LIFE) for begin, _ in free]
    scheduler, last, deaths = 0.0, 0.0, 0
    while shares:
        begin, number = heapq.heappop(free)
        scheduler = max(scheduler, begin) + SCHEDULER
        done = scheduler + work
        if done <= ends[number]:
            shares, last = shares - 1, max(last, done)
        else:
            # The share is repeated. In reality, the parts stored by the dead worker are kept; here they count as lost.
            deaths, done = deaths + 1, ends[number] + REPLACED
            ends[number] = done + chance.expovariate(1 / LIFE)
        heapq.heappush(free, (done, number))
    return last, deaths


def main(cases, workers, *counts):
    part = usual_part(cases)
    parts = -(-cases // part)
    print(f"{parts} parts of {part} cases, {part * BYTES / 1e6:.1f} MB each; table {cases * BYTES / 1e9:.1f} GB")
    for kind, case in CASE.items():
        print(f"{kind}: {cases * case / 3600:.1f} h on one thread")
        for count in counts or (parts, -(-parts // 10)):
            work = SHARE + cases / count * case
            time, deaths = simulated(count, work, workers)
            print(f"  {count} shares of {work:.2f} s: {time:.0f} s on {workers} workers, {deaths} of which died")
    merge = cases * BYTES / COPY + parts * PART
    print(f"merge: {merge:.0f} s, {parts * MEMORY / 1e6:.0f} MB of memory; a pass over the table: {cases * PASS:.0f} s")


if __name__ == "__main__":
    main(*(int(float(word)) for word in sys.argv[1:]))
