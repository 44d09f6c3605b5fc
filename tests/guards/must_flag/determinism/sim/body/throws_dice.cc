std::mt19937 dice;
