import turtle
axiom = "F"
rules = {"F": "F-F"}
def draw():
    pass
