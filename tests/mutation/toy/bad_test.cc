// The control: runs all of toy.cc but checks nothing, so it notices no mutant.
#include "toy.h"

int main() {
  for (int x = -9; x <= 9; ++x) {
    Sign(x), Negative(x), Scaled(x), Least(x, 2), Inside(x, 1, 4), Outside(x, 1, 4);
  }
  Sum({1, 2, 3});
  return 0;
}
