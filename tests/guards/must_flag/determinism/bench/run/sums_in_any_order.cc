std::unordered_map<int, double> values;
