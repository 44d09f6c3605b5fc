constexpr int kMostFrames = 3;
