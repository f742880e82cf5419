import pytest

from tests.picture.drawing import require_drawing


@pytest.fixture(scope="session")
def drawing() -> None:
    require_drawing()
