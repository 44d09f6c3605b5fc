#include "bench/peers/simbody_model.h"

#include <Simbody.h>

#include <exception>

namespace etude {
namespace {

SimTK::Vec3 ToVec(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
glm::dvec3 FromVec(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }

SimTK::Rotation ToRotation(const glm::dmat3& m) {
  const SimTK::Mat33 rows(m[0][0], m[1][0], m[2][0], m[0][1], m[1][1], m[2][1], m[0][2], m[1][2], m[2][2]);
  return SimTK::Rotation(rows, true);  // true = does not check that the matrix is orthogonal
}
SimTK::Transform ToTransform(const SimbodyModel::Frame& frame) {
  return SimTK::Transform(ToRotation(frame.axes), ToVec(frame.position));
}
SimbodyModel::Frame FromTransform(const SimTK::Transform& t) {
  const SimTK::Mat33 m = t.R().asMat33();
  return {FromVec(t.p()), glm::dmat3(FromVec(m(0)), FromVec(m(1)), FromVec(m(2)))};
}

}  // namespace

struct SimbodyModel::Parts {
  // An angle of the model. Angles are in the order of the joints.
  struct Angle {
    SimTK::MobilizedBody body;
    int axis;
  };

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  std::vector<SimTK::MobilizedBody> limbs;  // the body of each joint
  std::vector<SimTK::Transform> in_body;    // the frame of each joint in that joint's body
  std::vector<Angle> angles;
  std::vector<Effector> effectors;
  SimTK::State state;
  std::unique_ptr<SimTK::Assembler> assembler;
  SimTK::Markers* markers = nullptr;  // owned by the assembler
  SimTK::OrientationSensors* sensors = nullptr;

  // Gimbal rotates by Rx Ry Rz and Universal by Rx Ry, like the tree's joints. Pin rotates about its Z axis, so this
  // axis is turned onto the joint's X axis.
  void AddJoint(const Joint& joint) {
    using SimTK::MobilizedBody;
    if (joint.parent < 0 || joint.dof_count == 0) {
      limbs.push_back(joint.parent < 0 ? static_cast<MobilizedBody&>(matter.updGround()) : limbs[joint.parent]);
      in_body.push_back((joint.parent < 0 ? SimTK::Transform() : in_body[joint.parent]) * ToTransform(joint.base));
      return;
    }
    const SimTK::Body::Rigid body(SimTK::MassProperties(1, SimTK::Vec3(0), SimTK::Inertia(1)));
    const SimTK::Transform base = in_body[joint.parent] * ToTransform(joint.base), itself;
    MobilizedBody& parent = limbs[joint.parent];
    if (joint.dof_count == 1) {
      const SimTK::Transform x_to_z(SimTK::Rotation(SimTK::Pi / 2, SimTK::YAxis));
      limbs.push_back(MobilizedBody::Pin(parent, base * x_to_z, body, x_to_z));
    } else if (joint.dof_count == 2) {
      limbs.push_back(MobilizedBody::Universal(parent, base, body, itself));
    } else {
      limbs.push_back(MobilizedBody::Gimbal(parent, base, body, itself));
    }
    in_body.push_back(itself);
    for (int axis = 0; axis < joint.dof_count; ++axis) angles.push_back({limbs.back(), axis});
  }

  void SetAngles(const double* values) {
    for (std::size_t i = 0; i < angles.size(); ++i) angles[i].body.setOneQ(state, angles[i].axis, values[i]);
  }
};

SimbodyModel::SimbodyModel(const std::vector<Joint>& joints, const std::vector<Effector>& effectors,
                           const SimbodySettings& settings)
    : parts_(std::make_unique<Parts>()) {
  // Build the multibody system, with angles as coordinates.
  for (const Joint& joint : joints) parts_->AddJoint(joint);
  parts_->effectors = effectors;
  parts_->state = parts_->system.realizeTopology();
  parts_->matter.setUseEulerAngles(parts_->state, true);
  parts_->system.realizeModel(parts_->state);

  // Add a marker and an orientation sensor for each effector.
  parts_->assembler = std::make_unique<SimTK::Assembler>(parts_->system);
  SimTK::Assembler& assembler = *parts_->assembler;
  parts_->markers = new SimTK::Markers();
  parts_->sensors = new SimTK::OrientationSensors();
  for (const Effector& effector : effectors) {
    const SimTK::MobilizedBodyIndex limb = parts_->limbs[effector.joint].getMobilizedBodyIndex();
    parts_->markers->addMarker(limb, ToVec(effector.offset));
    parts_->sensors->addOSensor(limb, SimTK::Rotation());
  }
  // The weight of a single marker counts relative to other markers. `position_weight` is the weight of all markers
  // relative to all sensors.
  assembler.adoptAssemblyGoal(parts_->markers, settings.position_weight);
  assembler.adoptAssemblyGoal(parts_->sensors);
  assembler.setAccuracy(settings.accuracy);
  // Set the limits of the angles.
  std::size_t next = 0;
  for (const Joint& joint : joints) {
    for (int axis = 0; axis < joint.dof_count; ++axis, ++next) {
      assembler.restrictQ(parts_->angles[next].body.getMobilizedBodyIndex(), SimTK::MobilizerQIndex(axis),
                          joint.lower[axis], joint.upper[axis]);
    }
  }
  assembler.initialize(parts_->state);
}

SimbodyModel::~SimbodyModel() = default;

std::vector<SimbodyModel::Frame> SimbodyModel::Effectors(const double* angles) {
  parts_->SetAngles(angles);
  parts_->system.realize(parts_->state, SimTK::Stage::Position);
  std::vector<Frame> frames;
  for (const Effector& effector : parts_->effectors) {
    const SimTK::Transform& limb = parts_->limbs[effector.joint].getBodyTransform(parts_->state);
    frames.push_back(FromTransform(limb * SimTK::Transform(ToVec(effector.offset))));
  }
  return frames;
}

std::vector<double> SimbodyModel::Assemble(const double* start, const std::vector<Frame>& targets) {
  parts_->SetAngles(start);
  parts_->assembler->initialize(parts_->state);
  for (std::size_t e = 0; e < targets.size(); ++e) {
    const int index = static_cast<int>(e);
    parts_->markers->moveOneObservation(SimTK::Markers::ObservationIx(index), ToVec(targets[e].position));
    parts_->sensors->moveOneObservation(SimTK::OrientationSensors::ObservationIx(index), ToRotation(targets[e].axes));
  }
  try {
    parts_->assembler->track();
  } catch (const std::exception&) {
    // If the Assembler failed, its last state is judged like any other answer.
  }
  const SimTK::State& found = parts_->assembler->getInternalState();
  std::vector<double> angles;
  for (const Parts::Angle& angle : parts_->angles) angles.push_back(angle.body.getOneQ(found, angle.axis));
  return angles;
}

}  // namespace etude
