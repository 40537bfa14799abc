"""Meshes that follow a field: st-metric, st-prolong --background --only, st-mesh, and again."""
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
sys.path.insert(0, str(ROOT / "tests/support"))
from adapt_table import FIELDS, Loop, errors_by_level, gain_of, on_shape, order_of  # noqa: E402
from chain import BIN, MODELS, ToolTest  # noqa: E402


class Adapt(ToolTest):
    def test_the_error_of_interpolation_falls_with_second_order_and_is_a_quarter(self):
        for shape in ("sphere", "box"):
            (self.folder / shape).mkdir()
            loop = Loop(BIN, next(MODELS.glob(f"{shape}.*")), self.folder / shape)
            for name, field in FIELDS.items():
                rows = errors_by_level(loop, on_shape(field, shape), 2)
                self.assertGreater(order_of(rows), 1.8, f"{shape} {name}: {rows}")
                self.assertGreater(gain_of(rows[-1]), 4, f"{shape} {name}: {rows}")


if __name__ == "__main__":
    unittest.main(verbosity=2)
