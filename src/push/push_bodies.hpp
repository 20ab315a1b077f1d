// Which bodies a push may touch.
#pragma once

#include "mamo/model/problem.hpp"

namespace mamo::push {

struct PushBodies {
  ObjectSet forbidden;               // what the robot must not touch: fixtures, immovables, the object to retrieve
  ObjectSet standing;                // those of them that are no fixtures: the simulator moves them, so they are padded
  ObjectSet movable;                 // the others
  ObjectSet all;                     // all but fixtures: what is simulated
  ObjectId untouchable = kNoObject;  // the task's own object
};

PushBodies push_bodies(const Problem& problem);

}  // namespace mamo::push
