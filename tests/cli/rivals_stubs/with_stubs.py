"""with_stubs.py PROGRAM: runs a method with the packages of this folder instead of installed ones."""
import pathlib
import runpy
import sys

here = pathlib.Path(__file__).parent
del sys.argv[0]
sys.path[0] = str(pathlib.Path(sys.argv[0]).parent)
sys.path.insert(0, str(here))
runpy.run_path(sys.argv[0], run_name="__main__")
