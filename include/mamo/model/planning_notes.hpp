// What a planner wants people to see of its work: layers of marks, lines and cells over the scene, switched on and off
// in a playback page. Written only when PlanOptions::explain is set; nothing decides by them.
#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

#include "mamo/common/ids.hpp"

namespace mamo {

/// One point is a mark, more are a line.
struct NoteItem {
  std::string text;                     // one line for a person
  std::vector<Eigen::Vector3d> points;  // world, m; may be empty: then only the text is listed
  ObjectId object = kNoObject;          // what it is about
  int iteration = -1;                   // of planning, from 1; items of a layer stand in this order. -1: none
};

/// Cells of a cubic grid: cell (i, j, k) covers origin + cell * ([i, i+1) x [j, j+1) x [k, k+1)) in world.
struct NoteCells {
  double cell = 0.02;               // m
  Eigen::Vector3d origin{0, 0, 0};  // m
  std::vector<std::array<int, 3>> indices;
  std::vector<double> values;  // empty, or one per cell in [0, 1]: its colour, from near to far
};

/// Names that pages know and give their own colour: "negative goal region", "object paths", "relevant objects",
/// "failed pushes", "failed motions", "heuristic". Others are shown too.
struct NoteLayer {
  std::string name;
  std::string about;  // what one sees, in a sentence
  std::vector<NoteItem> items;
  NoteCells cells;
};

struct PlanningNotes {
  std::vector<NoteLayer> layers;
  bool empty() const { return layers.empty(); }
};

}  // namespace mamo
