#include "mamo/search/trace_domain.hpp"

#include "mamo/common/hash.hpp"

namespace mamo::search {

TraceDomain::TraceDomain(const Trace& trace) : trace_(trace) {
  for (std::size_t i = 0; i < trace.states.size(); ++i) states_[trace.states[i].id] = i;
  for (std::size_t i = 0; i < trace.jobs.size(); ++i) {
    const TraceJob& job = trace.jobs[i];
    commits_ += job.commit >= 0;
    if (job.done < 0 || job.cancelled) continue;
    jobs_[key(job.state, job.edge)] = i;
    finished_.push_back(i);
  }
}

const TraceState* TraceDomain::record(const State& s) const {
  const auto it = states_.find(s.id);
  return it == states_.end() ? nullptr : &trace_.states[it->second];
}

const TraceJob* TraceDomain::job(const State& s, std::int32_t action) const {
  const auto it = jobs_.find(key(s.id, action));
  return it == jobs_.end() ? nullptr : &trace_.jobs[it->second];
}

std::int32_t TraceDomain::class_of(const State& s) const {
  const TraceState* r = record(s);
  return r ? r->class_of : s.id;
}

bool TraceDomain::is_goal(const State& s) const {
  const TraceState* r = record(s);
  return r && r->goal;
}

Cost TraceDomain::heuristic(const State& s) const {
  const TraceState* r = record(s);
  return r ? r->heuristic : 0;
}

void TraceDomain::successors(Context&, const State& s, std::vector<LazyEdge>& edges) const {
  edges.clear();
  const TraceState* r = record(s);
  if (!r) return;
  for (const TraceState::Edge& e : r->edges) {
    edges.push_back({static_cast<std::int32_t>(edges.size()), e.cost, e.heuristic});
  }
}

EdgeOutcome<TraceDomain::State> TraceDomain::evaluate(Context&, const State& s, std::int32_t action,
                                                      const std::atomic<bool>*) const {
  EdgeOutcome<State> outcome;
  const TraceJob* j = job(s, action);
  if (!j) return outcome;
  outcome.valid = j->valid;
  outcome.charge = j->charge;
  outcome.child = {j->child};
  return outcome;
}

bool TraceDomain::known_child(const State& s, std::int32_t action, State& child) const {
  const TraceState* r = record(s);
  if (!r || r->edges[static_cast<std::size_t>(action)].known < 0) return false;
  child = {r->edges[static_cast<std::size_t>(action)].known};
  return true;
}

double TraceDomain::seconds(const State& s, std::int32_t action) const {
  if (const TraceJob* j = job(s, action)) return j->cpu_s;
  if (finished_.empty()) return 0;
  return trace_.jobs[finished_[mix64(key(s.id, action)) % finished_.size()]].cpu_s;
}

}  // namespace mamo::search
