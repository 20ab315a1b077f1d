// Writes down what the replay sees, for people to look at. Nothing reads it back into a judgement.
#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "mamo/model/problem.hpp"
#include "mamo/model/recording.hpp"
#include "mamo/physics/world.hpp"

namespace mamo::verify {

class Recorder {
 public:
  /// Fills `recording`, which outlives the recorder.
  Recorder(const Scene& scene, Recording& recording);

  /// After every step (and once before the first). `contacts`: the held object counted as robot.
  void note(const World& world, const std::vector<Contact>& contacts, double time_s, const Eigen::VectorXd& q);
  void grasped(double time_s) { out_.grasped_s = time_s; }
  /// Once, at the end: the last sample, and what never moved is left out.
  void finish();

 private:
  struct Now {  // an object since the last sample
    ObjectId id;
    Eigen::Isometry3d X_WO;
    Eigen::Vector3d up;  // the object's own axis that is vertical at the start
    double tilt = 0, speed = 0;
    bool moved = false;
  };
  void look(const World& world);
  void note_contacts(const World& world, const std::vector<Contact>& contacts, double time_s);
  void sample();

  const Scene& scene_;
  Recording& out_;
  int stride_;  // steps between samples
  int since_ = 0;
  double time_s_ = 0;
  Eigen::VectorXd q_;
  std::vector<Now> objects_;
  std::map<std::pair<ObjectId, ObjectId>, std::size_t> open_;  // contacts that hold at this moment
  std::set<ObjectId> driven_;                                  // by the robot, perhaps through others
};

}  // namespace mamo::verify
