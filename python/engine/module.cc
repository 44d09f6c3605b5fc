#include "python/engine/arrays.h"

PYBIND11_MODULE(etude_engine, module) {
  using namespace etude::engine;
  module.doc() = "Etude's engine on arrays: lengths are metres, angles radians, the world is right-handed with Y up.";
  pybind11::register_exception<BadInput>(module, "BadInput", PyExc_ValueError);
  module.attr("__version__") = std::string(Version());
  AddMotions(module);
  AddKinematics(module);
  AddCameras(module);
  AddVision(module);
  AddStreams(module);
}
