// Processor time, for measurements only: nothing may be decided by it.
#pragma once

namespace mamo {

/// Seconds of processor time that the calling thread has used. About 0.3 microseconds a call.
double thread_cpu_s();

}  // namespace mamo
