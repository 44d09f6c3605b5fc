"""The stored results of a sample: figure.json, and survivors.json with a reason for each survivor."""

import json
import math
from collections import Counter

NOTICED = ("killed", "crashed", "too slow")
NO_REASON = "not noticed"


def wilson(hits, total, z=1.959964):
    """Returns the 95 % interval of a share (Wilson 1927); (0, 1) if total is 0."""
    if total == 0:
        return 0.0, 1.0
    p, spread = hits / total, z * z / total
    middle = (p + spread / 2) / (1 + spread)
    half = z * math.sqrt(p * (1 - p) / total + spread / (4 * total)) / (1 + spread)
    return max(0.0, middle - half), min(1.0, middle + half)


def key(entry):
    """Returns what identifies a survivor after lines have moved."""
    return entry["file"], entry["code"], entry["original"], entry["mutation"]


def survivors_of(results, known):
    """Returns every unnoticed mutant, with its earlier reason if it has one."""
    reasons = {key(entry): entry["reason"] for entry in known}
    found = []
    for mutant, verdict in results:
        if verdict in NOTICED:
            continue
        entry = {"file": mutant.file, "code": mutant.code, "original": mutant.original, "mutation": mutant.mutation,
                 "verdict": verdict}
        found.append(entry | {"reason": reasons.get(key(entry), NO_REASON)})
    return sorted(found, key=key)


def is_equivalent(entry):
    return entry["reason"].startswith("equivalent")


def figure_of(results, survivors, about):
    """Returns the counts, and the shares of all mutants and of those that are not equivalent to the original."""
    verdicts = Counter(verdict for _, verdict in results)
    noticed, total = sum(verdicts[v] for v in NOTICED), len(results)
    equivalent = sum(is_equivalent(entry) for entry in survivors)

    def share(of):
        low, high = wilson(noticed, of)
        return {"of": of, "share": round(noticed / of, 4) if of else None, "wilson_95": [round(low, 4), round(high, 4)]}

    counts = {verdict.replace(" ", "_"): verdicts[verdict] for verdict in (*NOTICED, "survived", "unreached")}
    return about | {"sample": total, "noticed": noticed} | counts | {
        "equivalent": equivalent, "noticed_of_all": share(total), "noticed_of_different": share(total - equivalent)}


def by_folder(results):
    """Returns folder → (noticed, total)."""
    table = {}
    for mutant, verdict in results:
        noticed, total = table.get(mutant.folder, (0, 0))
        table[mutant.folder] = (noticed + (verdict in NOTICED), total + 1)
    return dict(sorted(table.items()))


def load(path):
    return json.loads(path.read_text()) if path.exists() else []


def save(path, data):
    path.write_text(json.dumps(data, indent=1, ensure_ascii=False) + "\n")
