#include <boost/math/distributions/normal.hpp>
