// Judging in one line, and verdicts that print themselves.
#pragma once

#include <gmock/gmock.h>

#include "mamo/verify/verifier.hpp"

namespace mamo::fixtures {

inline Verdict judge(const Problem& problem, const Plan& plan, const VerifyOptions& options = {}) {
  StopSource stop;
  return Verifier(options).judge(problem, plan, stop);
}

inline std::string report(const Verdict& verdict) {
  std::string text = verdict.ok ? "the plan holds\n" : "the plan does not hold\n";
  for (const Verdict::Finding& finding : verdict.findings) text += finding.text + "\n";
  return text;
}

/// The verdict's first finding is of this kind; use as EXPECT_TRUE(rejects(...)).
inline testing::AssertionResult rejects(const Verdict& verdict, ViolationKind kind, int segment = 0) {
  if (verdict.ok || verdict.findings.empty()) return testing::AssertionFailure() << report(verdict);
  const Verdict::Finding& first = verdict.findings.front();
  if (first.violation.kind != kind || first.segment != segment)
    return testing::AssertionFailure() << "expected " << to_string(kind) << " in segment " << segment << ", got\n"
                                       << report(verdict);
  return testing::AssertionSuccess();
}

inline testing::AssertionResult holds(const Verdict& verdict) {
  if (!verdict.ok || !verdict.findings.empty() || verdict.stopped)
    return testing::AssertionFailure() << report(verdict);
  return testing::AssertionSuccess();
}

}  // namespace mamo::fixtures
