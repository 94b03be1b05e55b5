"""Sweeps on many machines with Dask: `pip install linkproof[dask]`.

The workers of a cluster solve shares of the cases and write them into a directory that all of them and the client see.
"""

import hashlib
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from distributed import Client, as_completed

from linkproof._linkproof import Scenario, Sweep, resume
from linkproof.errors import LinkproofError, ReadError

#: Number of cases in a share. Batches solve them in about a second; reading and solving them singly takes much longer.
#: If a worker dies, the results that it has stored are kept, so a long share loses little work.
SHARE = 100_000


def digest(files: Sequence[str]) -> str:
    """SHA-256 of the bytes of some files in their order, as hexadecimal digits."""
    whole = hashlib.sha256()
    for name in files:
        with open(name, "rb") as file:
            whole.update(hashlib.file_digest(file, "sha256").digest())
    return whole.hexdigest()


def _solved(
    number: int, directory: str, count: int, path: str
) -> tuple[int, str, dict[Any, int]] | LinkproofError:
    """Solve a share on a worker. Its rows go to the directory; Dask carries the share, the digest and the counts only."""
    try:
        done = resume(directory, shard=(number, count), jobs=1, path=path)
    except ReadError:
        # Dask repeats the share: storage may be away for a moment.
        raise
    except LinkproofError as error:
        return error
    return number, digest(done.part_files), done.counts


def sweep(
    client: Client,
    scenario: Scenario,
    vary: Mapping[str, Any],
    figures: str | Sequence[str],
    *,
    out: str | os.PathLike[str],
    random: int | None = None,
    latin: int | None = None,
    sobol: int | None = None,
    seed: int = 1,
    prove_every: int | None = None,
    part: int | None = None,
    shards: int | None = None,
    retries: int = 3,
    allowed_failures: int = 1000,
    progress: Callable[[int, int], object] | None = None,
) -> Sweep:
    """Solve a sweep on the workers of a Dask cluster, and join its table.

    vary, figures, random, latin, sobol, seed, prove_every, part: as for `Scenario.sweep`; values are in the units of their keys.
    The bytes of the table are those of one machine.
    out: directory of the results, which the client and all workers see under the same path. The same call continues a sweep
    that was stopped.
    shards: number of shares. By default, a share has 100 000 cases, or fewer so that every thread of the cluster has four shares;
    it has at least one part.
    retries: how often a share is repeated after an exception. allowed_failures: how often it is repeated because its worker died;
    Dask's own 3 are too few if machines come and go.
    progress: a function of the number of cases that are done, and of all.

    A proof that disagrees is raised as `NumericError`, and no further share is begun.
    """
    out = os.path.abspath(out)
    plan = scenario.sweep(
        vary,
        figures,
        random=random,
        latin=latin,
        sobol=sobol,
        seed=seed,
        prove_every=prove_every,
        part=part,
        out=out,
        plan_only=True,
    )
    if plan.is_complete:
        return plan
    threads = sum(client.nthreads().values())
    count = min(plan.parts, shards or max(-(-plan.cases // SHARE), 4 * threads))

    # A function within a function travels by its code, so the scheduler need not have this package.
    def allow(number: int, dask_scheduler: Any = None) -> None:
        dask_scheduler.allowed_failures = max(dask_scheduler.allowed_failures, number)

    client.run_on_scheduler(allow, allowed_failures)
    files, cases = plan.part_files, 0
    # The scenario refers to tables in its own directory, and workers have another current directory.
    given = {"directory": out, "count": count, "path": os.path.abspath(scenario.path)}
    futures = client.map(_solved, range(1, count + 1), pure=False, retries=retries, batch_size=1000, **given)
    try:
        for future, found in as_completed(futures, with_results=True):
            # A result that nobody keeps is not computed again when its worker dies.
            future.release()
            if isinstance(found, LinkproofError):
                raise found
            number, told, counts = found
            _check(files[number - 1 :: count], told, number)
            cases += sum(counts.values())
            if progress is not None:
                progress(cases, plan.cases)
    finally:
        client.cancel(futures)
    return resume(out, path=scenario.path)


def _check(files: Sequence[str], told: str, number: int) -> None:
    """Check that the client sees the parts that a worker has written."""
    try:
        found = digest(files)
    except FileNotFoundError:
        found = ""
    if found != told:
        message = f"the client does not see the parts of share {number} as a worker has written them"
        help = "name a directory that the client and all workers see under the same path"
        raise ReadError(f"`out`: {message}\n  = help: {help}", message=message, key="out", help=help)
