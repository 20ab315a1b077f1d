// Exit codes of the tool, in one place.
#pragma once

#include "mamo/common/result.hpp"

namespace mamo::tool {

inline constexpr int kSolved = 0;
inline constexpr int kNoPlan = 1;
inline constexpr int kProven = 2;
inline constexpr int kInvalidInput = 3;
inline constexpr int kDoesNotHold = 4;
inline constexpr int kUsage = 64;
inline constexpr int kInternal = 70;
inline constexpr int kOutput = 73;

constexpr int exit_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::invalid_input:
      return kInvalidInput;
    case ErrorKind::usage:
      return kUsage;
    case ErrorKind::output:
      return kOutput;
    case ErrorKind::internal:
      return kInternal;
  }
  return kInternal;
}

}  // namespace mamo::tool
