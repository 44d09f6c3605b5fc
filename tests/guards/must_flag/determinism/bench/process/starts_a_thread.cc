std::thread reader;
