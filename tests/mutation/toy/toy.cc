#include "toy.h"

#include <algorithm>

constexpr double kScale = 2.5;
constexpr int kLowest = 3;
static_assert(kLowest > 2 && "no mutant here");

int Sign(int x) {
  if (x < 0) return -1;
  return x > 0 ? 1 : 0;
}

bool Inside(int x, int low, int high) { return low <= x && x <= high; }
bool Outside(int x, int low, int high) { return !(x >= low) || x > high || x == kLowest; }

int Sum(const std::vector<int>& numbers) {
  int sum = 0;
  for (const int number : numbers) sum += number;
  return sum;
}

int Least(int a, int b) { return std::min(a, b); }
double Scaled(double x) { return kScale * x - x / 2; }
int Negative(int x) { return -x; }
