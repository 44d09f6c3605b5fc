"""Lists the source tree's files, in a clone or in an unpacked archive."""
import os
import pathlib
import subprocess

MADE = {"build", "out", "dist", "node_modules", "__pycache__"}  # folders named in .gitignore


def source_files(root):
    """Returns paths below root that git knows or does not ignore; without git, all except MADE and hidden folders."""
    root = pathlib.Path(root)
    if (root / ".git").exists():
        listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=root, check=True,
                                capture_output=True, text=True).stdout.split("\0")
        return sorted(pathlib.Path(name) for name in listed if name and (root / name).is_file())
    found = []
    for folder, folders, names in os.walk(root):
        folders[:] = [name for name in folders if name not in MADE and name[0] != "."]
        found += [(pathlib.Path(folder) / name).relative_to(root) for name in names]
    return sorted(found)
