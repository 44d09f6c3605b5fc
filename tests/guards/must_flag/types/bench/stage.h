#pragma once

struct Stage {
  double wait_s = 0;
};
