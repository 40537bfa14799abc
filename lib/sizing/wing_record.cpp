#include "sizing/wing_record.h"

namespace st {

WingRecord moved(const Similarity& frame, WingRecord wing) {
  for (WingRecord::Station& s : wing.stations) {
    s.nose = frame(s.nose);
    s.trailing = frame(s.trailing);
    s.chord *= frame.scale;
    s.asked *= frame.scale;
  }
  wing.span *= frame.scale;
  return wing;
}

}  // namespace st
