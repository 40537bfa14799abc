// Time on a processor: what other programs take is not in it.
#pragma once

namespace st {

double thread_seconds();   ///< of the calling thread
double process_seconds();  ///< of this process, all its threads together

}  // namespace st
