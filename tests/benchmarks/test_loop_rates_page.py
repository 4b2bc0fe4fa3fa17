"""The page of the loop's rates, from a file of results."""

import json

import loop_rates_page
from PIL import Image
from test_effect_results import added, result


def records(count):
    return [result("lag", added("lag"))] * (count - 1) + [result("lag", name="clean/rover")]


def written(tmp_path, count):
    file = tmp_path / "results.jsonl"
    lines = [
        {"key": str(k), "code": "v1", "result": r | {"number": k}}
        for k, r in enumerate(records(count))
    ]
    file.write_text("".join(json.dumps(line) + "\n" for line in lines))
    return file


def test_the_page_says_how_few_cases_it_has(tmp_path):
    page, image = loop_rates_page.write([written(tmp_path, 5)], tmp_path)
    text = page.read_text()
    assert "A first look: rows of 0 to 4 cases" in text
    assert (
        "| one log, 8 sigmas, right class, nothing beside | 4 of 4, 1.000 (0.510 to 1.000) |"
        in text
    )
    assert r"x and \|x\| are the same up to their sign |" in text  # a bare one would end the cell
    with Image.open(image) as opened:
        assert min(opened.size) > 100
    assert loop_rates_page.write([tmp_path / "results.jsonl"], tmp_path) == []
    assert "commit" not in text
    loop_rates_page.write([tmp_path / "results.jsonl"], tmp_path, ["a1b2c3d"])
    assert "Made with the code of commit `a1b2c3d`." in page.read_text()


def test_the_matrix_has_a_row_for_each_truth():
    matrix = loop_rates_page.confusion(records(4))
    panel = loop_rates_page.picture(matrix).axes[0]
    assert [t.get_text() for t in panel.get_yticklabels()] == list(matrix)
    assert [t.get_text() for t in panel.texts] == ["3", "1"]
