NAME = "beside"


def twice(value):
    return 2 * value


def fail():
    return 1 / 0
