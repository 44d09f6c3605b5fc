#include <fstream>

void Save() { std::ofstream("baseline.json") << "{}"; }
