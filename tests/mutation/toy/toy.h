#pragma once

#include <vector>

int Sign(int x);
bool Inside(int x, int low, int high);
bool Outside(int x, int low, int high);
int Sum(const std::vector<int>& numbers);
int Least(int a, int b);
double Scaled(double x);
int Negative(int x);
