#pragma once

#include <etude/base.h>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/limb_lengths.h"
#include "engine/kinematics/solvers/gauss_newton.h"
