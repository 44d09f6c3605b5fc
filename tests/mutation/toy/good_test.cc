// Notices every mutant of toy.cc.
#include "toy.h"

int main() {
  for (int x = -9; x <= 9; ++x) {
    if (Sign(x) != (x == 0 ? 0 : x / (x < 0 ? -x : x))) return 1;
    if (Negative(x) + x != 0) return 1;
    if (Scaled(x) != x * 2.0) return 1;
    for (int low = -9; low <= 9; ++low) {
      if (Least(x, low) != (x < low ? x : low)) return 1;
      for (int high = low; high <= 9; ++high) {
        bool found = false;
        for (int y = low; y <= high; ++y) found = found || y == x;
        if (Inside(x, low, high) != found) return 1;
        if (Outside(x, low, high) != (!found || x == 3)) return 1;
      }
    }
  }
  return Sum({1, 2, 3}) == 6 && Sum({}) == 0 ? 0 : 1;
}
