
#include "engine/cameras/opencv_file.h"
#include "engine/cameras/pairs_file.h"
#include "engine/cameras/pose2sim_file.h"
#include "engine/cameras/rig_file.h"
#include "tests/fuzz/readers/target.h"

namespace etude::fuzz {
namespace {

std::vector<NamedCamera> TwoCameras() {
  NamedCamera left{"left", LookAt({}, {-2, 1, 3}, {0, 1, 0})}, right{"2 right", LookAt({}, {2, 1.5, 3}, {0, 1, 0})};
  right.camera.distortion.k1 = -0.1;
  return {left, right};
}

void Rig(std::string_view bytes) {
  const auto rig = ReadRig(bytes, kFile);
  if (rig) Required(ReadRig(WriteRig(*rig), kFile), "a rig that was written is not read");
}
void Pose2Sim(std::string_view bytes) {
  const auto rig = ReadPose2SimCalibration(bytes);
  if (rig) Required(ReadPose2SimCalibration(WritePose2SimCalibration(*rig)), "a rig that was written is not read");
}
void Qualisys(std::string_view bytes) { ReadQualisysCalibration(bytes); }
void Pairs(std::string_view bytes) { ReadPointPairs(bytes, kFile); }

std::vector<std::string> OpenCvSeeds() { return {WriteOpenCvCamera(TwoCameras()[1].camera)}; }
std::vector<std::string> Pose2SimSeeds() { return {WritePose2SimCalibration(TwoCameras())}; }
std::vector<std::string> QualisysSeeds() {
  return {
      R"(<?xml version="1.0" encoding="UTF-8"?>
<calibration calibrated-time="2020-06-14"><cameras><camera active="1" serial="23211" model="Miqus Video" viewrotation="0">
<fov_marker left="0" top="0" right="1919" bottom="1087"/><fov_video left="0" top="0" right="1919" bottom="1079"/>
<transform x="3150.1" y="-1200.5" z="2100" r11="1" r12="0" r13="0" r21="0" r22="0" r23="-1" r31="0" r32="1" r33="0"/>
<intrinsic focallength="9.1" sensorMinU="0" sensorMaxU="122816" sensorMinV="0" sensorMaxV="69568" focalLengthU="105000"
 focalLengthV="105000" centerPointU="61400" centerPointV="34800" skew="0" radialDistortion1="-0.05"
 radialDistortion2="0.08" radialDistortion3="0" tangentalDistortion1="0" tangentalDistortion2="0"/>
</camera></cameras></calibration>)"};
}
std::vector<std::string> RigSeeds() {
  return {WriteRig(TwoCameras()), OpenCvSeeds()[0], Pose2SimSeeds()[0], QualisysSeeds()[0]};
}

}  // namespace

std::vector<Target> CameraTargets() {
  return {
      {"rig",
       Rig,
       RigSeeds,
       {"!!opencv-matrix", "%YAML:1.0", "dt: d", "rows:", "cols:", ".Nan", ".Inf", "<!DOCTYPE", "&amp;"}},
      {"camera-pose2sim", Pose2Sim, Pose2SimSeeds, {"[metadata]", "fisheye = true", "nan", "inf", "#"}},
      {"camera-qualisys",
       Qualisys,
       QualisysSeeds,
       {"<!DOCTYPE", "<!ENTITY", "&amp;", "<![CDATA[", "viewrotation=\"90\""}},
      {"camera-pairs", Pairs,
       [] {
         return std::vector<std::string>{"camera,x,y,z,u,v\nleft,0,1,2,100.5,200\nright,1,1,2,3,4\n",
                                         "left: {size: [1920, 1080], pairs: [[0, 1, 2, 100, 200]]}\n"};
       }},
  };
}

}  // namespace etude::fuzz
