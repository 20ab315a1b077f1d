// A problem, a plan and its replay in three dimensions: a page that plays it, a picture of one moment.
#pragma once

#include <string>

#include "mamo/common/result.hpp"
#include "mamo/model/planner.hpp"
#include "mamo/model/recording.hpp"

namespace mamo::view {

/// What there is to show; what is null is left out. All outlive the call.
struct Playback {
  const Problem* problem = nullptr;      // never null
  const PlanResult* result = nullptr;    // of a run, solved or not
  const Recording* recording = nullptr;  // of the verification of result->plan
  const Verdict* verdict = nullptr;      // of the same
};

/// One self-contained HTML page: no network, opens from the disk. A pure function of its arguments and of the visual
/// meshes that the robot names (those that cannot be read are replaced by collision shapes).
std::string playback_page(const Playback& playback);

struct ImageOptions {
  int width = 1280, height = 800;  // px
  double time_s = 0;               // clamped to the recording
  bool dark = false;
  double yaw_deg = 0, pitch_deg = 0, zoom = 1;  // added to the default view
  bool paths = true;                            // of the tip and of the objects
};

/// A picture as PNG bytes, drawn in software. The failed plan's place is marked.
Result<std::string> playback_image(const Playback& playback, const ImageOptions& options = {});

}  // namespace mamo::view
