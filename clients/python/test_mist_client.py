"""The Python client against a running service.

    python3 clients/python/test_mist_client.py http://127.0.0.1:8650
"""

import contextlib
import io
import math
import os
import sys
import tempfile
import unittest

import mist_client

URL = sys.argv.pop() if len(sys.argv) > 1 else "http://127.0.0.1:8650"
GLASS = {
    "model": "Facet_BRDF_Model",
    "parameters": [["substrate", "(1.5,0)"], ["sdf", "Gaussian_Slope_Distribution_Function"], ["sdf.s", "0.3"]],
}
GRID = {"thetai": "0:15:75", "thetas": "0:15:75", "phis": "0:30:180", "lambda_": "400:50:700", "stokes": 1}
PROGRAM = """MODEL = Lambertian_BRDF_Model
VARIABLES:
  t = 0  incidentangle = t  incidentpol = (1,0,0,0)  rotation = 0  differential = 0.01  minsamples = 10
  $reflectance.table = r.txt
END
VARY: FOR t FROM 0 TO 0.2 BY 0.1 END
INTEGRALS: A = HEMI END END
OUTPUTS: 1 r=A END
FILES: results = r.dat listing = r.lst END
"""


class Client(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.service = mist_client.Service(URL)
        cls.service.put("client-glass", GLASS)
        cls.table = cls.service.table("client-glass", **GRID)

    def test_a_node_has_the_value_of_its_row(self):
        row = dict(zip(self.table.columns, self.table.rows[7 * (6 * 3 + 2) + 4]))
        self.assertEqual((row["thetai"], row["thetas"], row["phis"]), (45, 30, 120))
        self.assertAlmostEqual(self.table.lookup(45, 30, 120)["G"], row["G"], delta=1e-12)

    def test_between_nodes_the_value_lies_between_theirs(self):
        ends = [self.table.lookup(45, 45, phis)["I"] for phis in (0, 30)]
        self.assertAlmostEqual(self.table.lookup(45, 45, 15)["I"], sum(ends) / 2, delta=1e-12)

    def test_the_other_side_of_the_plane_of_incidence_is_its_mirror_image(self):
        here, there = (self.table.lookup(45, 40, phis) for phis in (50, -50))
        self.assertEqual((there["IQ"], there["IU"]), (here["IQ"], -here["IU"]))

    def test_two_crossed_filters_share_the_light(self):
        light = self.table.lookup(45, 40, 50)["R"]
        parts = [self.table.lookup(45, 40, 50, filter=angle)["R"] for angle in (20, 110)]
        self.assertAlmostEqual(sum(parts), light, delta=1e-12)

    def test_a_table_that_has_not_changed_does_not_travel_again(self):
        self.assertIs(self.service.table("client-glass", **GRID), self.table)

    def test_solid_angles_come_back_in_their_order(self):
        rows = ["45 60 0 circle 2", "45 45 0 circle 2"]
        found = self.service.integrate("client-glass", rows, lambda_="400:50:700")
        self.assertEqual([row[1] for row in found.rows], [60, 45])

    def test_directions_are_evaluated_in_one_request(self):
        up, side = [0.0, 0.0, 1.0], [0.6, 0.0, 0.8]
        found = self.service.evaluate("client-glass", [up + up, side + [-0.6, 0.0, 0.8]], out="rgb")
        self.assertEqual((len(found), len(found[0])), (2, 3))
        self.assertTrue(all(value > 0 for row in found for value in row))

    def test_a_program_runs_with_its_data_files(self):
        text = self.service.run(PROGRAM, {"r.txt": "0.3 0.5\n0.9 0.5\n"})
        self.assertEqual(len(text.strip().splitlines()), 4)

    def test_a_job_runs_in_the_background(self):
        job = self.service.submit(PROGRAM, {"r.txt": "0.3 0.5\n0.9 0.5\n"}, name="client")
        self.assertEqual(job.wait(300)["state"], "done")
        self.assertEqual(len(job.results().strip().splitlines()), 4)
        self.assertIn("Lambertian", job.listing())
        self.assertIn(job.id, [each["id"] for each in self.service.jobs()])
        job.delete()
        with self.assertRaises(mist_client.Refused):
            job.status()

    def test_spectra_and_exports_come_back(self):
        grid = {"thetai": "0:30:60", "thetas": "0:30:60", "phis": "0", "lambda_": "400:100:700"}
        spectra = self.service.spectra("client-glass", **grid)
        self.assertEqual((len(spectra.rows), spectra.columns[-4:]), (9, ["400", "500", "600", "700"]))
        self.assertTrue(self.service.export("client-glass", "table.bsdf", grid="8x16").startswith(b"tensor_file"))

    def test_a_promised_table_is_waited_for(self):
        grid = dict(GRID, thetai="0:5:75", thetas="0:2:76", wait=0)
        self.assertEqual(len(self.service.table("client-glass", **grid).axes["thetas"]), 39)

    def test_directions_outside_and_filters_without_stokes_components_are_refused(self):
        for place in [(80, 30, 0), (45, -1, 0), (45, math.nan, 0)]:
            with self.assertRaises(ValueError):
                self.table.lookup(*place)
        plain = self.service.table("client-glass", **dict(GRID, stokes=0))
        with self.assertRaises(ValueError):
            plain.lookup(45, 40, 0, filter=30)

    def test_the_example_of_the_module_runs_as_it_is_printed(self):
        lines = mist_client.__doc__.splitlines()
        example = "\n".join(line[4:] for line in lines if line.startswith("    "))
        with tempfile.TemporaryDirectory() as folder:
            program = os.path.join(folder, "white.mist")
            with open(program, "w", encoding="utf-8") as file:
                file.write(PROGRAM.replace("  $reflectance.table = r.txt\n", ""))
            example = example.replace("http://127.0.0.1:8650", URL).replace("white.mist", program)
            with contextlib.redirect_stdout(io.StringIO()) as printed:
                exec(example, {})
        self.assertEqual(len(printed.getvalue().strip().splitlines()), 4)

    def test_a_refusal_says_why(self):
        with self.assertRaises(mist_client.Refused) as caught:
            self.service.put("client-wrong", {"model": "Facet_BRDF_Modle"})
        self.assertEqual(caught.exception.status, 422)
        self.assertIn("Facet_BRDF_Model", str(caught.exception.problem))

    def test_a_table_that_is_cut_off_is_refused(self):
        with self.assertRaises(ValueError):
            mist_client.Table.parse("# MIST-TABLE 1\n# columns thetai\n1\n# end 2 0\n")

    def test_a_file_is_read_like_an_answer(self):
        path = f"/v1/materials/client-glass/table.mtab{mist_client._query(GRID)}"
        body, _ = self.service._ask("GET", path)
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "glass.mtab")
            with open(name, "wb") as file:
                file.write(body)
            self.assertEqual(mist_client.Table.read(name).lookup(20, 30, 40), self.table.lookup(20, 30, 40))


if __name__ == "__main__":
    unittest.main()
