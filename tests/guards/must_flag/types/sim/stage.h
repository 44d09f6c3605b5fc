#pragma once

class Stage {
  int seed_ = 0;
};
