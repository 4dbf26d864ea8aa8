#include "modules/ground/paper/paper_model.hpp"

namespace plumb {

PaperModel default_paper_model() {
  PaperModel model;
  model.dense_n1 = {-1.4e-4, 2.985e-3, 1.746e-6, 1.366e-3, 8.241e-5};
  model.dense_n3 = {-1.189e-4, 1.569e-2, 1.201e-6, 2.68e-3, 1.789e-4};
  model.dense_h = {-4.788e-3, 8.131e-2, 1.129e-4, 0.1023, 8.197e-3};
  model.points_h = {6.359e-2, -3.933e-4, 3.527e-3, 0.5235, 3.189e-2};
  // Detections come with their own variance; the mean is the paper's (Fig. 8).
  model.objects_n3 = {0.0, 1.0, 1e-6, 1e-2, 9.2e-5};
  return model;
}

}  // namespace plumb
