#include "mamo/search/trace.hpp"

#include <iomanip>
#include <istream>
#include <ostream>
#include <sstream>

namespace mamo::search {

std::int32_t Trace::begin_job(const Need& need, int worker, bool head, double now) {
  TraceJob job;
  job.state = need.parent.value;
  job.edge = need.edge;
  job.worker = worker;
  job.head = head;
  job.taken = now;
  if (head) {  // needed since it was announced, or since the job that had it was cancelled
    const bool announced = awaited_.parent == need.parent && awaited_.edge == need.edge;
    job.needed = announced ? awaited_at_ : now;
  }
  jobs.push_back(job);
  return static_cast<std::int32_t>(jobs.size() - 1);
}

void Trace::end_job(std::int32_t index, const Outcome& outcome, double cpu_s, double now) {
  TraceJob& job = jobs[static_cast<std::size_t>(index)];
  job.done = now;
  job.cpu_s = cpu_s;
  job.costly_s = 1e-6 * outcome.report.costly_us;
  job.valid = outcome.report.valid;
  job.cancelled = outcome.report.cancelled;
  job.charge = outcome.report.charge;
  job.child = outcome.child.value;
}

void Trace::need(const Need& need, std::int32_t job, double now) {
  if (job >= 0) {
    jobs[static_cast<std::size_t>(job)].needed = now;
  } else {
    awaited_ = need;
    awaited_at_ = now;
  }
}

void Trace::commit_job(std::int32_t job, double now) {
  jobs[static_cast<std::size_t>(job)].committed = now;
  jobs[static_cast<std::size_t>(job)].commit = commits_++;
}

namespace {
constexpr char kMagic[] = "mamo-trace/1";
}

void write_trace(const Trace& trace, std::ostream& out) {
  out << kMagic << ' ' << trace.weight << ' ' << trace.lazy << ' ' << trace.threads << ' ' << trace.schedule << ' '
      << trace.wall_s << ' ' << trace.start << ' ' << trace.states.size() << ' ' << trace.jobs.size() << '\n';
  for (const TraceState& s : trace.states) {
    out << "S " << s.id << ' ' << s.class_of << ' ' << s.goal << ' ' << s.heuristic << ' ' << s.edges.size();
    for (const TraceState::Edge& e : s.edges) out << ' ' << e.cost << ' ' << e.heuristic << ' ' << e.known;
    out << '\n';
  }
  out << std::setprecision(9);
  for (const TraceJob& j : trace.jobs) {
    out << "J " << j.state << ' ' << j.edge << ' ' << j.worker << ' ' << j.head << ' ' << j.taken << ' ' << j.done
        << ' ' << j.needed << ' ' << j.committed << ' ' << j.commit << ' ' << j.cpu_s << ' ' << j.costly_s << ' '
        << j.valid << ' ' << j.cancelled << ' ' << j.charge << ' ' << j.child << '\n';
  }
}

Result<Trace> read_trace(std::istream& in, const std::string& name) {
  Trace trace;
  std::string line, word;
  int number = 1;
  const auto bad = [&](const char* expected) {
    std::ostringstream text;
    text << name << ':' << number << ": not a trace, expected " << expected;
    return Error{text.str()};
  };
  std::size_t states = 0, jobs = 0;
  std::getline(in, line);
  std::istringstream header(line);
  if (!(header >> word >> trace.weight >> trace.lazy >> trace.threads >> trace.schedule >> trace.wall_s >>
        trace.start >> states >> jobs) ||
      word != kMagic) {
    return bad("a header of nine fields");
  }
  while (std::getline(in, line)) {
    ++number;
    std::istringstream fields(line);
    fields >> word;
    if (word == "S") {
      TraceState s;
      std::size_t edges = 0;
      fields >> s.id >> s.class_of >> s.goal >> s.heuristic >> edges;
      if (!fields || edges > line.size()) return bad("a state");
      s.edges.resize(edges);
      for (TraceState::Edge& e : s.edges) fields >> e.cost >> e.heuristic >> e.known;
      if (!fields) return bad("a state");
      trace.states.push_back(std::move(s));
    } else {
      TraceJob j;
      fields >> j.state >> j.edge >> j.worker >> j.head >> j.taken >> j.done >> j.needed >> j.committed >> j.commit >>
          j.cpu_s >> j.costly_s >> j.valid >> j.cancelled >> j.charge >> j.child;
      if (!fields || word != "J") return bad("a job");
      trace.jobs.push_back(j);
    }
  }
  if (trace.states.size() != states || trace.jobs.size() != jobs) return bad("as many lines as its header says");
  return trace;
}

}  // namespace mamo::search
